#pragma once

#include <QTableWidget>

#include "report/run/compare.h"

namespace chainmail {

/// Returns the name of a contestant without "ChainMail", which all names have; "3D ChainMail" stays.
QString shortName(std::string_view label);

/// All figures of a drag, with one row for each contestant. A click on a column header sorts by that column.
class ReportTable : public QTableWidget {
  Q_OBJECT

 public:
  ReportTable();
  void show(const report::DragResult& drag);
  /// Width at which no column is cut (pixels).
  int fullWidth() const;

 private:
  void fitColumns();
  void showColumn(const report::DragResult& drag, int column);
};

}  // namespace chainmail

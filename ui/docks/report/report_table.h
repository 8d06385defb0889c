#pragma once

#include <QTableWidget>
#include <vector>

#include "report/table/results.h"

namespace chainmail {

/// Returns the name of a contestant without "ChainMail", which most names have; "3D ChainMail" stays.
QString shortName(std::string_view label);

/// The figures of the contestants on one object, with one row for each contestant and one column for each figure that
/// was measured. A click on a column header sorts by that column.
class ReportTable : public QTableWidget {
  Q_OBJECT

 public:
  ReportTable();
  /// Shows means, or the worst, over the drags of the first object.
  void show(const report::Results& results);
  /// Shows all figures, or only those that a reader needs first.
  void showAll(bool all);
  /// Width at which no column is cut (pixels).
  int fullWidth() const;

 private:
  void setFigures(const report::Results& results);
  void fitColumns();
  void showColumn(int column, const std::vector<report::Row>& rows);

  std::vector<const report::Figure*> figures_;  // of the columns after the first one
  int first_ = 0;                               // number of those that are always shown
  bool all_ = false;
};

}  // namespace chainmail

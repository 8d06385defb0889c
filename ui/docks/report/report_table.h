#pragma once

#include <QTableWidget>

#include "report/run/compare.h"

namespace chainmail {

/// Every figure of a drag, a row a contestant; a click on a column's head sorts by it.
class ReportTable : public QTableWidget {
  Q_OBJECT

 public:
  ReportTable();
  void show(const report::DragResult& drag);
};

}  // namespace chainmail

#pragma once

#include <QLabel>
#include <QTableWidget>

#include "docks/size_test/size_test.h"

namespace chainmail {

/// The results of a size test so far: a verdict for each panel, and a row for each size.
class SizeTestTable : public QWidget {
  Q_OBJECT

 public:
  SizeTestTable();
  /// Clears the table for these panels.
  void begin(const std::vector<SizeTestContestant>& contestants);
  void add(const SizeTestRow& row);
  /// True while more results follow; the verdicts then say "so far".
  void setGrowing(bool growing);
  const std::vector<SizeTestRow>& rows() const { return rows_; }
  QTableWidget& table() { return *table_; }

 private:
  void showVerdicts();
  QString verdictText(const SizeTestContestant& contestant) const;
  void put(int row, int column, const QString& text, const QString& help = {});

  std::vector<SizeTestContestant> contestants_;
  std::vector<SizeTestRow> rows_;
  bool growing_ = false;
  QLabel* verdicts_;
  QTableWidget* table_;
};

}  // namespace chainmail

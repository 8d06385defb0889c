#pragma once

#include <QLabel>
#include <QTableWidget>

#include "docks/size_test/size_test.h"

namespace chainmail {

/// What a size test found so far: a verdict a panel, and a row a size, growing.
class SizeTestTable : public QWidget {
  Q_OBJECT

 public:
  SizeTestTable();
  /// Empties it, for these panels.
  void begin(const std::vector<SizeTestContestant>& contestants);
  void add(const SizeTestRow& row);
  /// Whether there is more to come, which the verdicts say.
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

#pragma once

#include <QLabel>
#include <QTableWidget>

#include "common/plot_widget.h"
#include "docks/size_test/size_test.h"

namespace chainmail {

/// The results of a size test so far: a verdict for each panel, a plot of time against size, and a row for each size.
class SizeTestResults : public QWidget {
  Q_OBJECT

 public:
  SizeTestResults();
  /// Clears the results for these panels. `budget` is the limit of real time in seconds.
  void begin(const std::vector<SizeTestContestant>& contestants, double budget);
  void add(const SizeTestRow& row);
  /// Set it while more results follow: the verdicts then say "so far".
  void setGrowing(bool growing);
  const std::vector<SizeTestRow>& rows() const { return rows_; }
  QTableWidget& table() { return *table_; }

 private:
  void showVerdicts();
  void showPlot();
  QString verdictText(const SizeTestContestant& contestant) const;
  void put(int row, int column, const QString& text, const QString& help = {});

  std::vector<SizeTestContestant> contestants_;
  std::vector<SizeTestRow> rows_;
  double budget_ = 0;
  bool growing_ = false;
  QLabel* verdicts_;
  PlotWidget* plot_;
  QTableWidget* table_;
};

}  // namespace chainmail

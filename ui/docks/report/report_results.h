#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>

#include "common/plot_pictures.h"
#include "docks/report/report_table.h"
#include "docks/report/report_thread.h"

namespace chainmail {

class PlotLegend;
class PlotWidget;

/// Shows the results of a run: one drag, or all, as a plot and a table, and the refused contestants with the reasons.
/// Saves the report and the plot.
class ReportResults : public QWidget {
  Q_OBJECT

 public:
  ReportResults();
  void show(const ReportThread::Results& results);
  /// Width at which no column of the table is cut (pixels).
  int tableWidth() const { return table_->fullWidth(); }
  /// Writes the files of the report into a folder.
  void saveTo(const QString& folder);
  /// The same, but asks before it replaces files.
  void askAndSaveTo(const QString& folder);
  /// Writes the plot shown as SVG, PDF or PNG, by the extension.
  void savePlotTo(const QString& path, const PlotSize& size);

 signals:
  void saved(const QString& path);
  void failed(const QString& sentence);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QLayout* makeBar();
  QWidget* makePlot();
  void showPlot();
  void showDrag();
  void save();
  void askWherePlot();

  ReportThread::Results results_;
  std::vector<std::pair<QString, report::Plot>> plots_;  // of the drag shown, with their names
  PlotSize size_;                                        // of the last saved plot
  QLabel* heading_;
  QComboBox* drag_;
  QComboBox* error_;
  QCheckBox* all_;
  QPushButton* savePlot_;
  QPushButton* save_;
  PlotWidget* plot_;
  PlotLegend* legend_;
  ReportTable* table_;
  QLabel* refusals_;
  QSplitter* split_;
};

}  // namespace chainmail

#pragma once

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QTableWidget>

#include "docks/report/report_thread.h"
#include "report/run/compare.h"

namespace chainmail {

class PlotLegend;
class PlotWidget;

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

/// Shows the results of a run: one drag as a plot and a table, and the refused algorithms with the reasons. Saves the
/// report.
class ReportResults : public QWidget {
  Q_OBJECT

 public:
  ReportResults();
  void show(const ReportThread::Result& result);
  /// Width at which no column of the table is cut (pixels).
  int tableWidth() const;
  /// Writes the three files of the report into a folder.
  void saveTo(const QString& folder);
  /// The same, but asks before it replaces files.
  void askAndSaveTo(const QString& folder);
  /// Writes the plot shown as SVG, PDF or PNG, by the extension.
  void savePlotTo(const QString& path);

 signals:
  void saved(const QString& path);
  void failed(const QString& sentence);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QLayout* makeBar();
  QWidget* makePlot();
  void showPlot(const report::DragResult& drag);
  void showDrag();
  void save();
  void askWherePlot();

  ReportThread::Result result_;
  QLabel* heading_;
  QComboBox* drag_;
  QComboBox* error_;
  QPushButton* savePlot_;
  QPushButton* save_;
  PlotWidget* plot_;
  PlotLegend* legend_;
  ReportTable* table_;
  QLabel* refusals_;
  QSplitter* split_;
};

}  // namespace chainmail

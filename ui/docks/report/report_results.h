#pragma once

#include <QComboBox>
#include <QLabel>
#include <QPushButton>

#include "docks/report/report_thread.h"

namespace chainmail {

class ReportPlot;
class ReportTable;

/// What a run found: a drag of it as plot and table, who was refused and why; to be saved and copied.
class ReportResults : public QWidget {
  Q_OBJECT

 public:
  ReportResults();
  void show(const ReportThread::Result& result);
  /// Writes the report's three files into a folder.
  void saveTo(const QString& folder);

 signals:
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  QLayout* makeBar();
  void showDrag();
  void save();
  void copy();

  ReportThread::Result result_;
  QLabel* heading_;
  QComboBox* drag_;
  QComboBox* error_;
  QPushButton* copy_;
  QPushButton* save_;
  ReportPlot* plot_;
  ReportTable* table_;
  QLabel* refusals_;
};

}  // namespace chainmail

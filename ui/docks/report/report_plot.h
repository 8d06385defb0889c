#pragma once

#include <QPixmap>
#include <QWidget>
#include <optional>
#include <span>

#include "report/run/compare.h"

class QChart;
class QChartView;
class QVBoxLayout;

namespace chainmail {

/// An error that the plot can show against time.
struct ReportError {
  const char* label;
  const char* unit;
  const char* axis;  // what its axis says: there is no room for both
  std::optional<double> (*of)(const report::Errors& errors);
};
std::span<const ReportError> reportErrors();

/// Time per move against an error, a mark a contestant, both axes logarithmic. Errors of 0, for which a
/// logarithmic axis has no place, stand on a line of their own below it.
class ReportPlot : public QWidget {
  Q_OBJECT

 public:
  ReportPlot();
  void show(const report::DragResult& drag, const ReportError& error);

 private:
  QChart* makeChart(const report::DragResult& drag, const ReportError& error);
  void addMark(QChart& chart, const report::Contestant& contestant, QPointF place, const QString& words);
  void fillLegend(const report::DragResult& drag);
  void addLegend(const QString& words, const QPixmap& mark = {});

  QChartView* view_;
  QVBoxLayout* legend_;
  QString help_;
};

}  // namespace chainmail

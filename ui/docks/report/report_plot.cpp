#include "docks/report/report_plot.h"

#include <QCategoryAxis>
#include <QChart>
#include <QChartView>
#include <QGraphicsLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QLineSeries>
#include <QScatterSeries>
#include <QToolTip>
#include <QVBoxLayout>
#include <memory>
#include <set>

#include "common/text.h"
#include "docks/report/report_looks.h"
#include "report/page/axis.h"
#include "report/page/format.h"

namespace chainmail {
namespace {

constexpr double smallestTime = 1e-9, smallestError = 1e-12;  // what is less stands at 0
constexpr int markSize = 15, legendMarkSize = 13;             // pixels
constexpr std::size_t mostTicksAcross = 5;                    // labels beside each other need their width
constexpr double margin = 0.05;                               // of an axis, so that no mark is cut off

std::optional<double> maxOf(const std::optional<Distance>& distance) {
  return distance ? std::optional(distance->max) : std::nullopt;
}
std::optional<double> rmsOf(const std::optional<Distance>& distance) {
  return distance ? std::optional(distance->rms) : std::nullopt;
}

constexpr std::array errors{ReportError{"max violation", "rest lengths", "violation (rest lengths)",
                                        [](auto& all) { return std::optional(all.violation.max); }},
                            ReportError{"RMS violation", "rest lengths", "violation (rest lengths)",
                                        [](auto& all) { return std::optional(all.violation.rms); }},
                            ReportError{"max distance to Exact", "mean rest lengths", "distance (mean rest lengths)",
                                        [](auto& all) { return maxOf(all.to_exact); }},
                            ReportError{"RMS distance to Exact", "mean rest lengths", "distance (mean rest lengths)",
                                        [](auto& all) { return rmsOf(all.to_exact); }}};

/// A contestant's place in the plot.
struct Mark {
  const report::Entry* entry;
  TimeSpread ms;
  double error;
};

std::vector<Mark> marksOf(const report::DragResult& drag, const ReportError& error) {
  std::vector<Mark> marks;
  for (const report::Entry& entry : drag.entries) {
    const auto value = entry.measurement ? error.of(entry.measurement->errors) : std::nullopt;
    if (value) {
      marks.push_back({&entry, entry.measurement->ms_per_move, *value});
    }
  }
  return marks;
}

QString inWords(const Mark& mark, const ReportError& error) {
  return QStringLiteral("%1\n%2 ms a move (quartiles %3 and %4)\n%5: %6 %7")
      .arg(text(report::label(mark.entry->contestant)), text(report::figure(mark.ms.median)),
           text(report::figure(mark.ms.lower_quartile)), text(report::figure(mark.ms.upper_quartile)),
           QLatin1String(error.label), text(report::figure(mark.error)), QLatin1String(error.unit));
}

/// The two axes, by which values become places from 0 to 1: Qt's own logarithmic axis has no 0.
struct Axes {
  explicit Axes(const std::vector<Mark>& marks)
      : time(values(
                 marks, [](const Mark& mark) { return mark.ms.lower_quartile; },
                 [](const Mark& mark) { return mark.ms.upper_quartile; }),
             smallestTime),
        error(values(
                  marks, [](const Mark& mark) { return mark.error; }, [](const Mark& mark) { return mark.error; }),
              smallestError) {}

  template <class Low, class High>
  static std::vector<double> values(const std::vector<Mark>& marks, Low low, High high) {
    std::vector<double> values;
    for (const Mark& mark : marks) {
      values.insert(values.end(), {low(mark), high(mark)});
    }
    return values;
  }

  QPointF place(double ms, double of) const { return {time.place(ms), error.place(of)}; }

  report::LogAxis time, error;
};

void addAxis(QChart& chart, const report::LogAxis& scale, Qt::Alignment side, const QString& title,
             const QPalette& palette) {
  auto* axis = new QCategoryAxis;
  axis->setLabelsPosition(QCategoryAxis::AxisLabelsPositionOnValue);
  axis->setStartValue(-margin);
  const auto ticks = scale.ticks();
  const std::size_t step = side == Qt::AlignBottom && ticks.size() > mostTicksAcross ? 2 : 1;
  for (std::size_t i = 0; i < ticks.size(); i += step) {
    axis->append(text(ticks[i].label), ticks[i].place);
  }
  axis->setTruncateLabels(false);
  axis->setRange(-margin, 1 + margin);
  axis->setTitleText(title);
  axis->setTitleBrush(palette.color(QPalette::WindowText));
  axis->setLabelsColor(palette.color(QPalette::WindowText));
  axis->setGridLineColor(palette.color(QPalette::Mid));
  QFont font;
  font.setPointSizeF(font.pointSizeF() - 1);
  axis->setTitleFont(font);
  axis->setLabelsFont(font);
  chart.addAxis(axis, side);
}

template <class Series>
Series* addSeries(QChart& chart, const QList<QPointF>& points, const QPen& pen) {
  auto* series = new Series;
  series->append(points);
  chart.addSeries(series);
  for (QAbstractAxis* axis : chart.axes()) {
    series->attachAxis(axis);
  }
  series->setPen(pen);
  return series;
}

}  // namespace

std::span<const ReportError> reportErrors() { return errors; }

ReportPlot::ReportPlot() : view_(new QChartView), legend_(new QVBoxLayout) {
  view_->setObjectName(QStringLiteral("reportPlot"));
  view_->setAccessibleName(QStringLiteral("Plot of time against error"));
  view_->setFrameShape(QFrame::NoFrame);
  view_->setBackgroundBrush(Qt::NoBrush);
  view_->setRenderHint(QPainter::Antialiasing);
  view_->setMinimumSize(220, 120);
  auto* legend = new QWidget;
  legend->setObjectName(QStringLiteral("reportLegend"));
  legend->setAccessibleName(QStringLiteral("What the marks of the plot stand for"));
  legend->setToolTip(QStringLiteral("Colour and shape tell the algorithm; bars are the quartiles of the time"));
  legend->setLayout(legend_);
  legend_->setContentsMargins(0, 0, 0, 0);
  legend_->setSpacing(2);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  row->addWidget(view_, 1);
  row->addWidget(legend, 0, Qt::AlignVCenter);
}

void ReportPlot::show(const report::DragResult& drag, const ReportError& error) {
  const std::unique_ptr<QChart> before(view_->chart());
  view_->setChart(makeChart(drag, error));
  help_ = QStringLiteral("Time per move against %1: left is faster, down is better; hover a mark for figures")
              .arg(QLatin1String(error.label));
  view_->setToolTip(help_);
  fillLegend(drag);
}

QChart* ReportPlot::makeChart(const report::DragResult& drag, const ReportError& error) {
  const std::vector<Mark> marks = marksOf(drag, error);
  const Axes axes(marks);
  auto* chart = new QChart;
  chart->legend()->hide();
  chart->setBackgroundVisible(false);
  chart->setMargins({});
  chart->layout()->setContentsMargins(0, 0, 0, 0);
  addAxis(*chart, axes.time, Qt::AlignBottom, QStringLiteral("ms a move"), QGuiApplication::palette());
  addAxis(*chart, axes.error, Qt::AlignLeft, QLatin1String(error.axis), QGuiApplication::palette());
  if (axes.error.has_zero()) {
    const double zero = axes.error.place(0);
    auto* line =
        addSeries<QLineSeries>(*chart, {{-margin, zero}, {1 + margin, zero}},
                               QPen(QGuiApplication::palette().color(QPalette::PlaceholderText), 1, Qt::DashLine));
    line->setName(QStringLiteral("zero"));
  }
  for (const Mark& mark : marks) {
    addMark(*chart, mark.entry->contestant, axes.place(mark.ms.median, mark.error), inWords(mark, error));
    addSeries<QLineSeries>(
        *chart, {axes.place(mark.ms.lower_quartile, mark.error), axes.place(mark.ms.upper_quartile, mark.error)},
        QPen(reportColour(mark.entry->contestant.algorithm), 1));
  }
  return chart;
}

void ReportPlot::addMark(QChart& chart, const report::Contestant& contestant, QPointF place, const QString& words) {
  auto* series = addSeries<QScatterSeries>(chart, {place}, Qt::NoPen);
  series->setName(text(report::label(contestant)));
  series->setMarkerShape(QScatterSeries::MarkerShapeRectangle);
  series->setMarkerSize(markSize);
  series->setBrush(QBrush(reportMark(contestant, markSize, devicePixelRatioF())));
  connect(series, &QScatterSeries::hovered, this, [this, words](const QPointF&, bool on) {
    view_->setToolTip(on ? words : help_);  // otherwise the plot's own would soon replace it
    on ? QToolTip::showText(QCursor::pos(), words) : QToolTip::hideText();
  });
}

/// A line an algorithm that takes part, and what filled and hollow marks mean.
void ReportPlot::fillLegend(const report::DragResult& drag) {
  while (QLayoutItem* item = legend_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  std::set<Algorithm> seen;
  std::set<int> sweeps;
  for (const report::Entry& entry : drag.entries) {
    const Algorithm algorithm = entry.contestant.algorithm;
    if (entry.measurement && seen.insert(algorithm).second) {
      addLegend(reportName({algorithm, 0}), reportMark({algorithm, 0}, legendMarkSize, devicePixelRatioF()));
    }
    sweeps.insert(entry.contestant.sweeps);
  }
  if (sweeps.contains(0)) {
    addLegend(QStringLiteral("filled: no sweeps"));
  }
  if (*sweeps.rbegin() > 0) {
    addLegend(QStringLiteral("hollow: %1 sweeps").arg(*sweeps.rbegin()));
  }
}

void ReportPlot::addLegend(const QString& words, const QPixmap& mark) {
  auto* line = new QWidget;
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(0, 0, 0, 0);
  if (!mark.isNull()) {
    auto* icon = new QLabel;
    icon->setPixmap(mark);
    row->addWidget(icon);
  }
  row->addWidget(new QLabel(words), 1);
  legend_->addWidget(line);
}

}  // namespace chainmail

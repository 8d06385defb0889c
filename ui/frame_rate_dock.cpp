#include "frame_rate_dock.h"

#include <QChart>
#include <QChartView>
#include <QGraphicsLayout>
#include <QGridLayout>
#include <QGuiApplication>
#include <QLineSeries>
#include <QVBoxLayout>
#include <QValueAxis>
#include <algorithm>

#include "colours.h"
#include "panel.h"
#include "parameter_row.h"

namespace chainmail {
namespace {

constexpr int refreshMilliseconds = 200;
constexpr double secondsShown = 10;
constexpr int figureWidth = 54;  // pixels: what 1,000,000 takes

QLabel* figure(const QString& name, colours::Colour colour) {
  auto* label = new QLabel(QStringLiteral("–"));
  label->setObjectName(name);
  label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  label->setMinimumWidth(figureWidth);
  followTheme(*label, [label, colour] { label->setStyleSheet(QStringLiteral("color:%1").arg(QColor(colour).name())); });
  return label;
}

}  // namespace

FrameRateDock::FrameRateDock(Document& document, std::vector<Panel*> panels,
                             const std::vector<colours::Colour>& colours)
    : QDockWidget(QStringLiteral("Frame rate")), document_(document), panels_(std::move(panels)) {
  setObjectName(QStringLiteral("frameRateDock"));
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  auto* grid = new QGridLayout;
  grid->addWidget(new QLabel(QStringLiteral("Painted frames/s")), 1, 0);
  grid->addWidget(new QLabel(QStringLiteral("Passes/s")), 2, 0);
  grid->addWidget(new QLabel(QStringLiteral("ms a pass, median")), 3, 0);
  grid->addWidget(new QLabel(QStringLiteral("ms a pass, worst")), 4, 0);
  grid->itemAtPosition(1, 0)->widget()->setToolTip(QStringLiteral("Frames that reached the screen in the last second"));
  grid->itemAtPosition(2, 0)->widget()->setToolTip(
      QStringLiteral("1 over the median time of a pass: what the algorithm alone could do"));
  for (int panel = 0; panel < Document::panels; ++panel) {
    Column& own = columns_[panel];
    auto* title = figure(QString(), colours[panel]);
    title->setText(panel == 0 ? QStringLiteral("Left") : QStringLiteral("Right"));
    own.painted = figure(QStringLiteral("painted%1").arg(panel), colours[panel]);
    own.passes = figure(QStringLiteral("passes%1").arg(panel), colours[panel]);
    own.median = figure(QStringLiteral("median%1").arg(panel), colours[panel]);
    own.worst = figure(QStringLiteral("worst%1").arg(panel), colours[panel]);
    int row = 0;
    for (QLabel* label : {title, own.painted, own.passes, own.median, own.worst}) {
      grid->addWidget(label, row++, panel + 1);
    }
  }
  column->addLayout(grid);
  column->addWidget(makeChart(colours), 1);
  content->setMinimumWidth(dockWidth);
  setWidget(content);
  clock_.start();
  timer_.setInterval(refreshMilliseconds);
  connect(&timer_, &QTimer::timeout, this, qOverload<>(&FrameRateDock::refresh));
  connect(&document, &Document::frameReady, this, [this] {
    if (!timer_.isActive()) {
      timer_.start();
    }
  });
}

QWidget* FrameRateDock::makeChart(const std::vector<colours::Colour>& colours) {
  auto* chart = new QChart;
  chart->legend()->hide();
  chart->setBackgroundVisible(false);
  chart->setMargins({});
  chart->layout()->setContentsMargins(0, 0, 0, 0);
  time_ = new QValueAxis;
  milliseconds_ = new QValueAxis;
  time_->setLabelsVisible(false);
  time_->setTickCount(2);
  milliseconds_->setTickCount(3);
  milliseconds_->setLabelFormat(QStringLiteral("%.3g"));
  chart->addAxis(time_, Qt::AlignBottom);
  chart->addAxis(milliseconds_, Qt::AlignLeft);
  for (int panel = 0; panel < Document::panels; ++panel) {
    auto* series = new QLineSeries;
    chart->addSeries(series);
    series->attachAxis(time_);
    series->attachAxis(milliseconds_);
    columns_[panel].series = series;
  }
  scaleChart(0);
  auto* view = new QChartView(chart);
  view->setToolTip(QStringLiteral("Milliseconds a pass over the last 10 seconds"));
  view->setMinimumHeight(110);
  view->setFrameShape(QFrame::NoFrame);
  view->setBackgroundBrush(Qt::NoBrush);
  followTheme(*view, [this, colours] {
    for (QValueAxis* axis : {time_, milliseconds_}) {
      axis->setLabelsColor(QGuiApplication::palette().color(QPalette::WindowText));
      axis->setGridLineColor(QGuiApplication::palette().color(QPalette::Mid));
    }
    for (int panel = 0; panel < Document::panels; ++panel) {
      columns_[panel].series->setPen(QPen(QColor(colours[std::size_t(panel)]), 1.5));
    }
  });
  return view;
}

void FrameRateDock::refresh() {
  const double now = double(clock_.elapsed()) / 1000;
  bool busy = false;
  for (int panel = 0; panel < Document::panels; ++panel) {
    busy = refresh(panel, now) || busy;
  }
  scaleChart(now);
  if (!busy) {
    timer_.stop();  // until the next frame
  }
}

bool FrameRateDock::refresh(int panel, double now) {
  Column& own = columns_[panel];
  const Frame* frame = document_.frame(panel);
  const int painted = panels_[panel]->view().meter().framesPerSecond();
  own.painted->setText(painted == 0 ? QStringLiteral("idle") : QString::number(painted));
  if (frame == nullptr) {
    return true;
  }
  const auto& statistics = frame->statistics;
  if (statistics.passes != own.passesSeen && statistics.last_second.passes != 0) {
    own.passesSeen = statistics.passes;
    const QLocale locale;
    const auto& times = statistics.last_second;
    own.passes->setText(times.median_ms > 0 ? locale.toString(1000 / times.median_ms, 'f', 0) : QStringLiteral("–"));
    own.median->setText(locale.toString(times.median_ms, 'f', 3));
    own.worst->setText(locale.toString(times.worst_ms, 'f', 3));
    own.series->append(now, times.median_ms);
  }
  while (own.series->count() > 0 && own.series->at(0).x() < now - secondsShown) {
    own.series->remove(0);
  }
  return painted != 0;
}

void FrameRateDock::scaleChart(double now) {
  double highest = 0;
  for (const Column& own : columns_) {
    for (const QPointF& point : own.series->points()) {
      highest = std::max(highest, point.y());
    }
  }
  time_->setRange(now - secondsShown, now);
  milliseconds_->setRange(0, highest > 0 ? highest * 1.2 : 1);
}

}  // namespace chainmail

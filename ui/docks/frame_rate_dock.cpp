#include "docks/frame_rate_dock.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QSettings>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/actions.h"
#include "common/as_path.h"
#include "common/dock_scroll.h"
#include "common/icons.h"
#include "common/text.h"
#include "document/panel_colour.h"
#include "files/text/outputs.h"
#include "io/questions.h"
#include "mesh/error.h"
#include "panels/panel.h"
#include "report/table/format.h"

namespace chainmail {
namespace {

constexpr int rateColumns = 4;
constexpr std::array rateWidths{54, 58, 52, 52};  // logical pixels; wide enough for the headers and for 1,000,000

constexpr int refreshMilliseconds = 200;

QString quantityKey() { return QStringLiteral("rateQuantity"); }
QString spanKey() { return QStringLiteral("rateSeconds"); }

/// Returns a tick for every quarter of the period, labelled with the seconds before its end.
std::vector<report::LabelledValue> timeTicks(double from, double to) {
  constexpr int intervals = 4;
  std::vector<report::LabelledValue> ticks;
  for (int i = 0; i <= intervals; ++i) {
    const double before = (to - from) * (intervals - i) / intervals;
    ticks.push_back({to - before, (before > 0 ? "−" : "") + report::figure(std::round(10 * before) / 10) + " s"});
  }
  return ticks;
}

}  // namespace

RateFigures::RateFigures(const Document& document) : document_(document) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(3);
  grid->setVerticalSpacing(1);
  addHead(*grid);
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    addRow(*grid);
  }
  followPanels();
  connect(&document, &Document::panelsChanged, this, &RateFigures::followPanels);
  connect(&document, &Document::algorithmChanged, this, [this](int panel) {
    clear(panel);
    followPanels();  // the colours of other panels may change, too
  });
}

void RateFigures::addHead(QGridLayout& grid) {
  const auto add = [&](int column, const QString& text, const QString& help) {
    auto* label = new QLabel(text);
    label->setAlignment(Qt::AlignRight);
    label->setToolTip(help);
    label->setMinimumWidth(std::max(rateWidths[std::size_t(column)], label->minimumSizeHint().width()));
    grid.addWidget(label, 0, column);
    grid.setColumnStretch(column, 1);
  };
  add(0, QStringLiteral("painted/s"), QStringLiteral("Frames that reached the screen in the last second"));
  add(1, QStringLiteral("passes/s"),
      QStringLiteral("1 over the median time of a pass: the rate of the algorithm without drawing"));
  add(2, QStringLiteral("median"), QStringLiteral("Median time of a pass over the last second"));
  add(3, QStringLiteral("worst"), QStringLiteral("Longest pass of the last second"));
}

/// Adds the row of a panel. The panel's name has its own line, because the four figures need the width.
void RateFigures::addRow(QGridLayout& grid) {
  const int panel = int(rows_.size());
  const auto figure = [&](const char* name, const QString& meaning) {
    auto* label = new QLabel(QStringLiteral("–"));
    label->setObjectName(QStringLiteral("%1%2").arg(QLatin1String(name)).arg(panel));
    label->setAlignment(Qt::AlignRight);
    label->setAccessibleDescription(meaning);
    return label;
  };
  Row row{new QLabel, nullptr, nullptr, nullptr, nullptr};
  row.name->setObjectName(QStringLiteral("rateName%1").arg(panel));
  row.painted = figure("painted", QStringLiteral("Painted frames per second"));
  row.passes = figure("passes", QStringLiteral("Passes per second"));
  row.median = figure("median", QStringLiteral("Median time of a pass"));
  row.worst = figure("worst", QStringLiteral("Longest pass"));
  row.name->setTextFormat(Qt::RichText);
  row.name->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  const int line = 2 * panel + 1;
  grid.addWidget(row.name, line, 0, 1, rateColumns);
  int column = 0;
  for (QLabel* label : {row.painted, row.passes, row.median, row.worst}) {
    grid.addWidget(label, line + 1, column++);
  }
  rows_.push_back(row);
  followTheme(*row.name, [this, panel] { nameRow(panel); });
}

/// Hides the rows of missing panels.
void RateFigures::followPanels() {
  for (int panel = 0; panel < int(rows_.size()); ++panel) {
    const Row& row = rows_[std::size_t(panel)];
    for (QLabel* label : {row.name, row.painted, row.passes, row.median, row.worst}) {
      label->setVisible(panel < document_.panels());
    }
    nameRow(panel);
  }
}

void RateFigures::nameRow(int panel) {
  const Row& row = rows_[std::size_t(panel)];
  row.name->setText(QStringLiteral("<span style='color:%1'>━━</span> <b>%2</b> %3")
                        .arg(QColor(panelColour(document_, panel)).name(), panelName(panel),
                             text(info(document_.algorithm(panel)).label)));
}

void RateFigures::clear(int panel) {
  const Row& row = rows_[std::size_t(panel)];
  for (QLabel* label : {row.passes, row.median, row.worst}) {
    label->setText(QStringLiteral("–"));
  }
}

void RateFigures::show(int panel, const RateSample& sample) {
  const Row& row = rows_[std::size_t(panel)];
  row.painted->setText(sample.painted > 0 ? QString::number(int(sample.painted)) : QStringLiteral("idle"));
  if (std::isnan(sample.medianMs)) {
    return;
  }
  const double passes = sample.passesPerSecond();
  row.passes->setText(std::isnan(passes) ? QStringLiteral("–") : shownRate(passes));
  row.median->setText(shownTime(sample.medianMs));
  row.worst->setText(shownTime(sample.worstMs));
}

FrameRateDock::FrameRateDock(Document& document, const std::vector<Panel*>& panels, Actions& actions)
    : document_(document),
      panels_(panels),
      histories_(Document::maxPanels),
      seen_(Document::maxPanels),
      object_(document.unsplitMesh()),
      figures_(new RateFigures(document)),
      plot_(new PlotWidget(QStringLiteral("Drag the object to see its rates"))),
      quantity_(new QComboBox),
      span_(new QComboBox),
      timer_(this) {
  plot_->setObjectName(QStringLiteral("ratePlot"));
  plot_->setAccessibleName(QStringLiteral("Rates of the panels over time"));
  plot_->setToolTip(QStringLiteral(
      "One line for each panel, in its colour. A line ends where nothing happened. Point at a line to see its values"));
  addActions(actions);
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(5, 4, 5, 4);
  column->setSpacing(4);
  column->addWidget(figures_);
  column->addWidget(makeControls(actions));
  column->addWidget(plot_, 1);
  setWidget(new DockScroll(content));
  clock_.start();
  timer_.setInterval(refreshMilliseconds);
  connect(&timer_, &QTimer::timeout, this, &FrameRateDock::refresh);
  connect(&document.solvers(), &PanelSolvers::frameReady, this, &FrameRateDock::receive);
  connect(&document, &Document::panelLeaves, this, &FrameRateDock::forget);
  connect(&document, &Document::meshChanged, this, [this] {
    if (std::exchange(object_, document_.unsplitMesh()) != document_.unsplitMesh()) {
      for (int panel = 0; panel < Document::maxPanels; ++panel) {
        forget(panel);
      }
      showPlot();
    }
  });
  connect(&document, &Document::panelsChanged, this, &FrameRateDock::showPlot);
  followTheme(*this, [this] { showPlot(); });
}

void FrameRateDock::forget(int panel) {
  histories_[std::size_t(panel)] = {};
  seen_[std::size_t(panel)] = {};
  figures_->clear(panel);
}

void FrameRateDock::fillChoices() {
  quantity_->setObjectName(QStringLiteral("rateQuantity"));
  quantity_->setAccessibleName(QStringLiteral("Plotted quantity"));
  for (const RateQuantity& one : rateQuantities()) {
    quantity_->addItem(QStringLiteral("%1 (%2)").arg(text(one.label), text(one.unit)), text(one.name));
    quantity_->setItemData(quantity_->count() - 1, text(one.help), Qt::ToolTipRole);
  }
  quantity_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  span_->setObjectName(QStringLiteral("rateSpan"));
  span_->setAccessibleName(QStringLiteral("Plotted period"));
  span_->setToolTip(QStringLiteral("Length of the plotted period; the last 10 minutes are kept"));
  for (const int seconds : {10, 30, 60, 300, 600}) {
    span_->addItem(seconds < 60 ? QStringLiteral("%1 s").arg(seconds) : QStringLiteral("%1 min").arg(seconds / 60),
                   seconds);
  }
  const QSettings settings;
  quantity_->setCurrentIndex(std::max(0, quantity_->findData(settings.value(quantityKey(), QStringLiteral("ms")))));
  span_->setCurrentIndex(std::max(0, span_->findData(settings.value(spanKey(), 10).toInt())));
  connect(quantity_, &QComboBox::activated, this, &FrameRateDock::choose);
  connect(span_, &QComboBox::activated, this, &FrameRateDock::choose);
}

QWidget* FrameRateDock::makeControls(const Actions& actions) {
  fillChoices();
  auto* pause = new QToolButton;
  pause->setDefaultAction(&actions["pauseRates"]);
  auto* save = new QToolButton;
  save->setObjectName(QStringLiteral("rateSave"));
  save->setIcon(icon("save"));
  save->setAccessibleName(QStringLiteral("Save the rates as a table or a picture"));
  save->setToolTip(save->accessibleName());
  save->setPopupMode(QToolButton::InstantPopup);
  save->addActions(actions.all({"saveRateTable", "saveRatePicture"}));
  auto* controls = new QWidget;
  auto* column = new QVBoxLayout(controls);
  column->setContentsMargins(0, 2, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  row->addWidget(span_, 1);
  row->addWidget(pause);
  row->addWidget(save);
  column->addWidget(quantity_);
  column->addLayout(row);
  return controls;
}

void FrameRateDock::addActions(Actions& actions) {
  actions.add("View", {{"rates", "&Rates over time", "frameRate"}});
  actions.add("rates", {{"pauseRates", "&Pause the plot|Pause", "pause", "Pause",
                         "Stops the plot of the frame rate; nothing is recorded until you continue",
                         [this](bool on) { pauses_ = on; }, IsOn([this] { return pauses_; })},
                        {"saveRateTable", "Save rates as &table…", "save", "",
                         "Saves all quantities of the last 10 minutes as CSV, with all digits and time in seconds",
                         [this] { saveTable(); }},
                        {"saveRatePicture", "Save rates as p&icture…", "picture", "",
                         "Saves the present plot with its legend as PNG, or as SVG or PDF for print",
                         [this] { savePicture(); }}});
}

void FrameRateDock::receive(int panel) {
  if (std::size_t(panel) >= panels_.size()) {
    return;
  }
  const Frame* frame = document_.solvers().frame(panel);
  if (frame != nullptr && !pauses_) {
    RateSample sample = read(panel);
    const Statistics& statistics = frame->statistics;
    Seen& seen = seen_[std::size_t(panel)];
    if (std::exchange(seen.passes, statistics.passes) == statistics.passes) {
      sample.ms = sample.medianMs = sample.worstMs = RateSample::none;
    }
    if (std::exchange(seen.measured, statistics.violation.at) == statistics.violation.at) {
      sample.violationMax = sample.violationRms = RateSample::none;  // a sample has it already
    }
    histories_[std::size_t(panel)].add(sample);
  }
  if (!timer_.isActive()) {
    timer_.start();
  }
}

/// Returns the current figures of a panel.
RateSample FrameRateDock::read(int panel) {
  RateSample sample;
  sample.time = now();
  sample.painted = panels_[std::size_t(panel)]->view().meter().framesPerSecond();
  sample.algorithm = document_.algorithm(panel);
  if (const Frame* frame = document_.solvers().frame(panel)) {
    const Statistics& statistics = frame->statistics;
    sample.violationMax = statistics.violation.max;
    sample.violationRms = statistics.violation.rms;
    sample.ofWholeMesh = statistics.violation.is_whole;
    sample.lag = statistics.residual.value_or(RateSample::none);
    if (statistics.last_second.passes != 0 && statistics.algorithm == sample.algorithm) {
      sample.ms = statistics.last_pass_ms;
      sample.medianMs = statistics.last_second.median_ms;
      sample.worstMs = statistics.last_second.worst_ms;
    }
  }
  return sample;
}

/// Reads the figures on a timer, because painting may continue or end without a new frame of the solver.
void FrameRateDock::refresh() {
  bool busy = false;
  for (int panel = 0; panel < int(panels_.size()); ++panel) {
    const RateSample sample = read(panel);
    figures_->show(panel, sample);
    busy = busy || sample.painted > 0;
    if (!pauses_) {
      RateSample painted;
      painted.time = sample.time;
      painted.painted = sample.painted;
      painted.algorithm = sample.algorithm;
      histories_[std::size_t(panel)].add(painted);
    }
  }
  if (!pauses_) {
    shownTo_ = now();
    showPlot();
  }
  if (!busy) {
    timer_.stop();  // until the next frame
  }
}

void FrameRateDock::choose() {
  QSettings settings;
  settings.setValue(quantityKey(), quantity_->currentData());
  settings.setValue(spanKey(), span_->currentData());
  showPlot();
}

void FrameRateDock::showPlot() {
  quantity_->setToolTip(quantity_->currentData(Qt::ToolTipRole).toString());
  plot_->show(plotOn(colours::ground()));
}

report::Plot FrameRateDock::plotOn(colours::Ground ground) const {
  const RateQuantity& quantity = rateQuantities()[std::size_t(quantity_->currentIndex())];
  const double seconds = span_->currentData().toDouble(), from = shownTo_ - seconds;
  report::Plot plot;
  plot.title = std::string(quantity.label) + " (" + std::string(quantity.unit) + ")";
  plot.x = {{}, "s", 0, true, {{from, shownTo_}}, timeTicks(from, shownTo_), shownTo_};
  plot.y = {{}, std::string(quantity.unit), 0, true};
  plot.panels.emplace_back();
  for (std::size_t panel = 0; panel < panels_.size(); ++panel) {
    const QString name = panelName(int(panel)) + QLatin1Char(' ') + text(info(document_.algorithm(int(panel))).label);
    plot.series.push_back({name.toStdString(), 0, panelColour(document_, int(panel)).on(ground).name().toStdString()});
    for (const QPolygonF& line :
         curveOf(histories_[panel].since(from), quantity, from, shownTo_, drawnPoints / panels_.size())) {
      report::PlotCurve& curve = plot.panels.front().curves.emplace_back(report::PlotCurve{panel, {}});
      for (const QPointF& point : line) {
        curve.points.push_back({point.x(), point.y()});
      }
    }
  }
  return plot;
}

void FrameRateDock::saveTable() {
  const QString path = askWhere(*this, QStringLiteral("Save rates as table"),
                                {QStringLiteral("Comma-separated values (*.csv)")}, QStringLiteral("rates"));
  if (!path.isEmpty()) {
    saveTablePath(path);
  }
}

void FrameRateDock::saveTablePath(const QString& path) {
  attempt(path, [&] { write_file(asPath(path), [this](std::ostream& out) { writeCsv(out, histories_); }); });
}

void FrameRateDock::savePicture() {
  const QString path = askWhere(*this, QStringLiteral("Save rates as picture"), plotFilters(), QStringLiteral("rates"));
  if (!path.isEmpty()) {
    savePicturePath(path);
  }
}

void FrameRateDock::savePicturePath(const QString& path) {
  attempt(path, [&] { savePlot(plotOn(colours::Ground::light), path); });
}

void FrameRateDock::attempt(const QString& path, const std::function<void()>& write) {
  try {
    write();
    emit saved(path);
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

}  // namespace chainmail

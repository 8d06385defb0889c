#include "panels/panel.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>

#include "common/panel_names.h"

namespace chainmail {
namespace {

constexpr int refreshMilliseconds = 100;

}  // namespace

Panel::Panel(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
             std::shared_ptr<MeshLevels> levels)
    : document_(document),
      colouring_(colouring),
      panel_(panel),
      statistics_(new QLabel),
      view_(new View(document, colouring, links, panel, std::move(camera), std::move(levels))),
      head_(new PanelHead(document, *view_, panel)),
      legend_(new Legend),
      refresh_(this) {
  view_->setObjectName(QStringLiteral("view%1").arg(panel));
  legend_->setObjectName(QStringLiteral("legend%1").arg(panel));
  statistics_->setObjectName(QStringLiteral("statistics%1").arg(panel));
  statistics_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  statistics_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  arrange();
  listen();
  showStatistics();
}

void Panel::listen() {
  refresh_.setSingleShot(true);
  refresh_.setInterval(refreshMilliseconds);
  connect(&refresh_, &QTimer::timeout, this, &Panel::showStatistics);
  connect(&document_, &Document::frameReady, this, [this](int ready) {
    if (ready == panel_ && !refresh_.isActive()) {
      refresh_.start();
    }
  });
  connect(view_, &View::drawnStepChanged, &refresh_, qOverload<>(&QTimer::start));
  connect(view_, &View::resized, &refresh_, qOverload<>(&QTimer::start));
  connect(view_, &View::ghostChanged, &refresh_, qOverload<>(&QTimer::start));
  connect(&document_, &Document::pinsChanged, &refresh_, qOverload<>(&QTimer::start));
  connect(&document_, &Document::cutsChanged, &refresh_, qOverload<>(&QTimer::start));
  connect(&colouring_, &Colouring::modeChanged, this, &Panel::showStatistics);
  connect(&colouring_, &Colouring::changed, this, [this] {
    if (!refresh_.isActive()) {
      refresh_.start();
    }
  });
}

/// The figures below the view.
void Panel::arrange() {
  auto* foot = new QHBoxLayout;
  foot->setContentsMargins(8, 4, 8, 6);
  foot->addWidget(statistics_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(head_);
  column->addWidget(legend_);
  column->addWidget(view_, 1);
  column->addLayout(foot);
}

/// Where the pass did not end where it should have, why is more than how far the links are off.
QString Panel::describe(const Statistics& statistics, bool briefly) const {
  return describePass(statistics, briefly) + QStringLiteral("<br>") +
         (statistics.remark.empty() ? describeViolation(statistics, briefly) : describeRemark(statistics));
}

QString Panel::describePass(const Statistics& statistics, bool briefly) {
  const QLocale locale;
  const bool solved = elastic_method(statistics.algorithm).has_value();
  const QString looked = solved    ? QStringLiteral("solved for <b>%2</b>")
                         : briefly ? QStringLiteral("looked at <b>%2</b>")
                                   : QStringLiteral("links looked at <b>%2</b>");
  return (QStringLiteral("moved <b>%1</b> · ") + looked + QStringLiteral(" · <b>%3</b> ms") +
          (briefly ? QString() : QStringLiteral(" a pass")))
      .arg(locale.toString(qulonglong(statistics.last_pass.moved)),
           locale.toString(qulonglong(statistics.last_pass.checked)), locale.toString(statistics.last_pass_ms, 'f', 3));
}

QString Panel::describeViolation(const Statistics& statistics, bool briefly) {
  const QLocale locale;
  const Violation& violation = statistics.violation;
  const QString of = briefly                              ? QString()
                     : statistics.violation_of_whole_mesh ? QStringLiteral(" of all links:")
                                                          : QStringLiteral(" of touched links:");
  return QStringLiteral("violation%1 max <b>%2</b> · RMS <b>%3</b> · <b>%4</b> %")
      .arg(of, locale.toString(violation.max, 'g', 3), locale.toString(violation.rms, 'g', 3),
           locale.toString(100 * violation.fraction, 'f', 1));
}

QString Panel::describeRemark(const Statistics& statistics) const {
  const QString remark = QString::fromStdString(statistics.remark);
  return statistics_->fontMetrics().elidedText(remark, Qt::ElideRight, statistics_->width()).toHtmlEscaped();
}

/// In fewer words where the panel is narrow.
void Panel::showFigures(const Statistics& statistics) {
  const QString help = QStringLiteral(
      "Violation: how far links lie outside their valid regions, in rest lengths; the last figure is "
      "the share of links above 1e-4.\nDuring a drag it covers the links that the pass touched, at rest "
      "all links.");
  statistics_->setToolTip(statistics.remark.empty() ? help : QString::fromStdString(statistics.remark));
  statistics_->setText(describe(statistics, false));
  if (statistics_->sizeHint().width() > statistics_->width()) {
    statistics_->setText(describe(statistics, true));
  }
}

QStringList Panel::states(const Statistics& statistics) const {
  QStringList states;
  if (document_.lacksPins(panel_)) {
    states << QStringLiteral("nothing pinned: no answer");
  }
  if (statistics.last_pass.stopped) {
    states << QStringLiteral("taut: pins hold the hand");
  }
  if (document_.parts() > 1) {
    states << QStringLiteral("%L1 parts").arg(document_.parts());
  }
  if (!document_.pins().empty()) {
    states << QStringLiteral("%L1 pinned").arg(document_.pins().size());
  }
  if (statistics.relaxing) {
    states << QStringLiteral("relaxing, sweep %L1").arg(statistics.sweeps);
  }
  if (const Ghost& ghost = view_->ghost(); ghost.of) {
    states << QStringLiteral("ghost of %1, %2 %").arg(panelName(*ghost.of)).arg(std::lround(100 * ghost.blend));
  }
  if (view_->drawnStep() > 1) {
    states << QStringLiteral("drawn coarsely, 1 in %1").arg(view_->drawnStep());
  }
  if (view_->leavesLinksOut()) {
    states << QStringLiteral("links show when nearer");
  }
  return states + view_->notes();
}

void Panel::refresh() {
  view_->update();
  if (!refresh_.isActive()) {
    refresh_.start();
  }
}

void Panel::showStatistics() {
  if (const auto legend = view_->overlayLegend()) {
    legend_->show(*legend);
  } else {
    legend_->follow(colouring_, panel_);
  }
  if (const Frame* frame = document_.frame(panel_)) {
    showFigures(frame->statistics);
    head_->showState(states(frame->statistics).join(QStringLiteral(" · ")));
  }
}

}  // namespace chainmail

#include "panel.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "text.h"

namespace chainmail {
namespace {

constexpr int refreshMilliseconds = 100;

}  // namespace

Panel::Panel(Document& document, int panel, std::shared_ptr<Camera> camera, QColor colour)
    : document_(document),
      panel_(panel),
      selector_(new QComboBox),
      state_(new QLabel),
      statistics_(new QLabel),
      view_(new View(document, panel, std::move(camera), colour)) {
  view_->setObjectName(QStringLiteral("view%1").arg(panel));
  fillSelector();
  statistics_->setObjectName(QStringLiteral("statistics%1").arg(panel));
  statistics_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  statistics_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  statistics_->setToolTip(
      QStringLiteral("Violation: how far links lie outside their valid regions, in rest lengths; the last figure is "
                     "the share of links above 1e-4.\nDuring a drag it covers the links that the pass touched, at rest "
                     "all links."));
  arrange(colour);

  refresh_.setSingleShot(true);
  refresh_.setInterval(refreshMilliseconds);
  connect(&refresh_, &QTimer::timeout, this, &Panel::showStatistics);
  connect(&document, &Document::frameReady, this, [this](int ready) {
    if (ready == panel_ && !refresh_.isActive()) {
      refresh_.start();
    }
  });
  connect(view_, &View::drawnStepChanged, &refresh_, qOverload<>(&QTimer::start));
  showStatistics();
}

void Panel::fillSelector() {
  selector_->setObjectName(QStringLiteral("algorithm%1").arg(panel_));
  selector_->setAccessibleName(QStringLiteral("Algorithm of this panel"));
  selector_->setToolTip(QStringLiteral("The algorithm that deforms this panel's object"));
  for (const auto& info : algorithms()) {
    selector_->addItem(text(info.label), int(info.algorithm));
  }
  selector_->setCurrentIndex(selector_->findData(int(document_.algorithm(panel_))));
  connect(selector_, &QComboBox::activated, this,
          [this] { document_.setAlgorithm(panel_, Algorithm(selector_->currentData().toInt())); });
}

/// The selector above the view, the figures below it.
void Panel::arrange(QColor colour) {
  auto* swatch = new QLabel;
  swatch->setFixedSize(10, 10);
  swatch->setStyleSheet(QStringLiteral("background:%1; border-radius:5px").arg(colour.name()));
  auto* head = new QHBoxLayout;
  head->setContentsMargins(8, 6, 8, 6);
  head->setSpacing(8);
  head->addWidget(swatch);
  head->addWidget(selector_);
  head->addStretch();
  head->addWidget(state_);
  auto* foot = new QHBoxLayout;
  foot->setContentsMargins(8, 4, 8, 6);
  foot->addWidget(statistics_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(view_, 1);
  column->addLayout(foot);
}

QString Panel::describe(const Statistics& statistics) const {
  const QLocale locale;
  const Violation& violation = statistics.violation;
  return QStringLiteral(
             "moved <b>%1</b> · links looked at <b>%2</b> · <b>%3</b> ms a pass<br>"
             "violation of %4: max <b>%5</b> · RMS <b>%6</b> · <b>%7</b> %")
      .arg(locale.toString(qulonglong(statistics.last_pass.moved)),
           locale.toString(qulonglong(statistics.last_pass.checked)), locale.toString(statistics.last_pass_ms, 'f', 3),
           statistics.violation_of_whole_mesh ? QStringLiteral("all links") : QStringLiteral("touched links"),
           locale.toString(violation.max, 'g', 3), locale.toString(violation.rms, 'g', 3),
           locale.toString(100 * violation.fraction, 'f', 1));
}

void Panel::showStatistics() {
  const Frame* frame = document_.frame(panel_);
  if (frame == nullptr) {
    return;
  }
  statistics_->setText(describe(frame->statistics));
  QStringList states;
  if (frame->statistics.relaxing) {
    states << QStringLiteral("relaxing, sweep %L1").arg(frame->statistics.sweeps);
  }
  if (view_->drawnStep() > 1) {
    states << QStringLiteral("drawn coarsely, 1 in %1").arg(view_->drawnStep());
  }
  state_->setText(states.join(QStringLiteral(" · ")));
}

}  // namespace chainmail

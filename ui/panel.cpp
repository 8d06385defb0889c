#include "panel.h"

#include <QHBoxLayout>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include "mesh/error.h"
#include "text.h"

namespace chainmail {
namespace {

constexpr int refreshMilliseconds = 100;

}  // namespace

Panel::Panel(Document& document, Colouring& colouring, int panel, std::shared_ptr<Camera> camera,
             std::shared_ptr<MeshLevels> levels, colours::Colour colour)
    : document_(document),
      colouring_(colouring),
      panel_(panel),
      selector_(new QComboBox),
      state_(new QLabel),
      statistics_(new QLabel),
      view_(new View(document, colouring, panel, std::move(camera), std::move(levels), colour)),
      legend_(new Legend) {
  view_->setObjectName(QStringLiteral("view%1").arg(panel));
  state_->setObjectName(QStringLiteral("state%1").arg(panel));
  state_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  // What it says comes and goes during a drag: the view must not change its size with it.
  state_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  legend_->setObjectName(QStringLiteral("legend%1").arg(panel));
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
  connect(&document, &Document::pinsChanged, &refresh_, qOverload<>(&QTimer::start));
  connect(&colouring, &Colouring::modeChanged, this, &Panel::showStatistics);
  connect(&colouring, &Colouring::changed, this, [this] {
    if (!refresh_.isActive()) {
      refresh_.start();
    }
  });
  showStatistics();
}

void Panel::fillSelector() {
  selector_->setObjectName(QStringLiteral("algorithm%1").arg(panel_));
  selector_->setAccessibleName(QStringLiteral("Algorithm of this panel"));
  selector_->setToolTip(QStringLiteral("The algorithm that deforms this panel's object"));
  for (const auto& info : algorithms()) {
    selector_->addItem(text(info.label), int(info.algorithm));
  }
  connect(selector_, &QComboBox::activated, this,
          [this] { document_.setAlgorithm(panel_, Algorithm(selector_->currentData().toInt())); });
  connect(&document_, &Document::algorithmChanged, this, [this](int panel) {
    if (panel == panel_) {
      showAlgorithm();
    }
  });
  connect(&document_, &Document::meshChanged, this, &Panel::showAlgorithm);
  showAlgorithm();
}

/// What runs, and what does not work on this mesh, with the reason.
void Panel::showAlgorithm() {
  const auto* items = qobject_cast<QStandardItemModel*>(selector_->model());
  for (int i = 0; i < selector_->count(); ++i) {
    const auto algorithm = Algorithm(selector_->itemData(i).toInt());
    QString help = text(info(algorithm).source);
    try {
      check(algorithm, *document_.mesh());
      items->item(i)->setEnabled(true);
    } catch (const Error& error) {
      items->item(i)->setEnabled(false);
      help = QString::fromStdString(error.what());
    }
    items->item(i)->setToolTip(help);
  }
  selector_->setCurrentIndex(selector_->findData(int(document_.algorithm(panel_))));
}

/// The selector above the view, the figures below it.
void Panel::arrange(colours::Colour colour) {
  auto* swatch = new QLabel;
  swatch->setFixedSize(10, 10);
  followTheme(*swatch, [swatch, colour] {
    swatch->setStyleSheet(QStringLiteral("background:%1; border-radius:5px").arg(QColor(colour).name()));
  });
  auto* head = new QHBoxLayout;
  head->setContentsMargins(8, 6, 8, 6);
  head->setSpacing(8);
  head->addWidget(swatch);
  head->addWidget(selector_);
  head->addWidget(state_, 1);
  auto* foot = new QHBoxLayout;
  foot->setContentsMargins(8, 4, 8, 6);
  foot->addWidget(statistics_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(legend_);
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

QStringList Panel::states(const Statistics& statistics) const {
  QStringList states;
  if (statistics.last_pass.stopped) {
    states << QStringLiteral("taut: pins hold the hand");
  }
  if (!document_.pins().empty()) {
    states << QStringLiteral("%L1 pinned").arg(document_.pins().size());
  }
  if (statistics.relaxing) {
    states << QStringLiteral("relaxing, sweep %L1").arg(statistics.sweeps);
  }
  if (view_->drawnStep() > 1) {
    states << QStringLiteral("drawn coarsely, 1 in %1").arg(view_->drawnStep());
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
  legend_->showScale(colouring_.mode(), colouring_.scale());
  if (const Frame* frame = document_.frame(panel_)) {
    statistics_->setText(describe(frame->statistics));
    const QString state = states(frame->statistics).join(QStringLiteral(" · "));
    state_->setText(state_->fontMetrics().elidedText(state, Qt::ElideRight, state_->width()));
    state_->setToolTip(state);
  }
}

}  // namespace chainmail

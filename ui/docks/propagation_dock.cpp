#include "docks/propagation_dock.h"

#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>

#include "common/actions.h"
#include "common/dock_scroll.h"

namespace chainmail {
namespace {

constexpr std::array speeds{1, 2, 5, 10, 30, 100, 1000, 10'000};  // steps per second
constexpr int usualSpeed = 5;
// Width (pixels) below which the lists of the panels are below each other: a dock takes up to a quarter of it.
constexpr int smallWindow = 1760;

}  // namespace

PropagationDock::PropagationDock(Document& document, Propagation& propagation, PropagationOverlay& overlay,
                                 Actions& actions)
    : propagation_(propagation),
      overlay_(overlay),
      lists_(new QGridLayout),
      speed_(new QComboBox),
      together_(new QCheckBox(QStringLiteral("&Together"))),
      arrows_(new QCheckBox(QStringLiteral("&Arrows"))) {
  addActions(actions);
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->addWidget(makeButtons(actions));
  column->addWidget(makeChoices(actions));
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    columns_.push_back(new PropagationColumn(document, propagation, panel));
  }
  arrangeLists();
  const auto adapt = [this, &document] {
    for (int panel = 0; panel < Document::maxPanels; ++panel) {
      columns_[std::size_t(panel)]->setVisible(panel < document.panels());
    }
  };
  connect(&document, &Document::panelsChanged, this, adapt);
  adapt();
  column->addLayout(lists_, 1);
  setWidget(new DockScroll(content));
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool seen) {
    propagation_.setShown(seen);
    followDock();
  });
  connect(&propagation, &Propagation::changed, this, &PropagationDock::refresh);
  connect(&document, &Document::algorithmChanged, this, &PropagationDock::refresh);
  refresh();
}

/// Sets two lists side by side, like the panels, or one in a small window.
void PropagationDock::arrangeLists() {
  const QWidget* main = parentWidget();
  const int perRow = main != nullptr && main->width() < smallWindow ? 1 : 2;
  for (int panel = 0; panel < int(columns_.size()); ++panel) {
    lists_->addWidget(columns_[std::size_t(panel)], panel / perRow, panel % perRow);  // moves a list that is in it
  }
}

bool PropagationDock::event(QEvent* event) {
  if (event->type() == QEvent::ParentChange && parentWidget() != nullptr) {
    parentWidget()->installEventFilter(this);
    arrangeLists();
  }
  return QDockWidget::event(event);
}

bool PropagationDock::eventFilter(QObject* watched, QEvent* event) {
  if (watched == parentWidget() && event->type() == QEvent::Resize) {
    arrangeLists();
  }
  return QDockWidget::eventFilter(watched, event);
}

/// Opens at once. Closes later, because a dock behind another one is hidden for a moment when its key brings it to the
/// front.
void PropagationDock::followDock() {
  if (!isHidden()) {
    propagation_.setOpen(true);
  } else {
    QMetaObject::invokeMethod(
        this, [this] { propagation_.setOpen(!isHidden()); }, Qt::QueuedConnection);
  }
}

void PropagationDock::addActions(Actions& actions) {
  const When ready([this] {
    return !propagation_.isShown()   ? QStringLiteral("Not available: open the Propagation dock first (O)")
           : !propagation_.hasPass() ? QStringLiteral("Not available: there is no pass yet; drag an element")
                                     : QString();
  });
  actions.add("View", {{"steps", "Steps of the p&ass", "stepForward"}});
  actions.add(
      "steps",
      {{"passFirst", "&First step", "toStart", "Ctrl+,",
        "Goes to the start of the pass: the handle is at its target, all other elements have not moved yet",
        [this] { propagation_.goTo(0); }, ready},
       {"passBack", "Step &back", "stepBack", ",", "Goes back by one candidate of the pass",
        [this] { propagation_.stepBy(-1); }, ready},
       {"passPlay", "&Slow motion", "play", "Ctrl+Space", "Plays the pass at the selected speed, or pauses",
        [this](bool on) { propagation_.setPlays(on); }, ready, IsOn([this] { return propagation_.plays(); }),
        Appears([this] { return Appearance{.icon = propagation_.plays() ? "pause" : "play"}; })},
       {"passForward", "Step f&orward", "stepForward", ".", "Goes forward by one candidate of the pass",
        [this] { propagation_.stepBy(1); }, ready},
       {"passLast", "&Last step", "toEnd", "Ctrl+.", "Goes to the end of the pass",
        [this] { propagation_.goTo(propagation_.stepCount()); }, ready},
       {},
       {"passFollow", "Follow &drag", "", "Shift+O", "On: always shows the last pass. Off: keeps the present pass",
        [this](bool on) { propagation_.setShowsNewest(on); }, ready,
        IsOn([this] { return propagation_.showsNewest(); })}});
  connect(this, &PropagationDock::changed, &actions, [&actions] { actions.refreshMenu(QStringLiteral("steps")); });
}

QWidget* PropagationDock::makeButtons(Actions& actions) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  for (QAction* action : actions.all({"passFirst", "passBack", "passPlay", "passForward", "passLast"})) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setFocusPolicy(Qt::StrongFocus);
    layout->addWidget(button);
  }
  makeSpeeds();
  layout->addSpacing(6);
  layout->addWidget(speed_);
  layout->addStretch();
  return row;
}

void PropagationDock::makeSpeeds() {
  speed_->setObjectName(QStringLiteral("passSpeed"));
  speed_->setAccessibleName(QStringLiteral("Speed of slow motion"));
  speed_->setToolTip(QStringLiteral("Speed of slow motion (candidates per second)"));
  for (const int speed : speeds) {
    speed_->addItem(QStringLiteral("%L1 / s").arg(speed), speed);
  }
  connect(speed_, &QComboBox::currentIndexChanged, this,
          [this] { propagation_.setSpeed(speed_->currentData().toDouble()); });
  speed_->setCurrentIndex(speed_->findData(usualSpeed));
}

QWidget* PropagationDock::makeChoices(Actions& actions) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* follow = new QToolButton;
  follow->setDefaultAction(&actions["passFollow"]);
  follow->setFocusPolicy(Qt::StrongFocus);
  layout->addWidget(follow);
  together_->setObjectName(QStringLiteral("passTogether"));
  together_->setChecked(true);
  together_->setToolTip(QStringLiteral("On: all panels go to the same step. Off: only the selected panel steps"));
  arrows_->setObjectName(QStringLiteral("passArrows"));
  arrows_->setChecked(true);
  arrows_->setToolTip(QStringLiteral("Shows arrows from each sponsor to the element that it has updated"));
  layout->addWidget(together_);
  layout->addWidget(arrows_);
  layout->addStretch();
  connect(together_, &QCheckBox::toggled, &propagation_, &Propagation::setTogether);
  connect(arrows_, &QCheckBox::toggled, this, [this](bool on) {
    overlay_.setArrows(on);
    emit changed();
  });
  return row;
}

void PropagationDock::refresh() {
  for (PropagationColumn* column : columns_) {
    column->refresh();
  }
  emit changed();
}

}  // namespace chainmail

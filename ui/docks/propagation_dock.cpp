#include "docks/propagation_dock.h"

#include <QAction>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>

#include "common/dock_scroll.h"
#include "common/icons.h"

namespace chainmail {
namespace {

constexpr std::array speeds{1, 2, 5, 10, 30, 100, 1000, 10'000};  // steps per second
constexpr int usualSpeed = 5;
// Width (pixels) below which the lists of the panels are below each other: a dock takes up to a quarter of it.
constexpr int smallWindow = 1760;

}  // namespace

PropagationDock::PropagationDock(Document& document, Propagation& propagation, PropagationOverlay& overlay)
    : propagation_(propagation),
      overlay_(overlay),
      lists_(new QGridLayout),
      speed_(new QComboBox),
      together_(new QCheckBox(QStringLiteral("&Together"))),
      arrows_(new QCheckBox(QStringLiteral("&Arrows"))) {
  makeActions();
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->addWidget(makeButtons());
  column->addWidget(makeChoices());
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

QAction* PropagationDock::add(const QString& name, const QString& text, const QKeySequence& key, const QString& tip) {
  auto* action = new QAction(text, this);
  action->setObjectName(name);
  action->setShortcut(key);
  action->setStatusTip(tip);
  return action;
}

void PropagationDock::makeActions() {
  first_ =
      add(QStringLiteral("passFirst"), QStringLiteral("&First step"), Qt::CTRL | Qt::Key_Comma,
          QStringLiteral(
              "Goes to the start of the pass: the handle is at its target, all other elements have not moved yet"));
  back_ = add(QStringLiteral("passBack"), QStringLiteral("Step &back"), Qt::Key_Comma,
              QStringLiteral("Goes back by one candidate of the pass"));
  play_ = add(QStringLiteral("passPlay"), QStringLiteral("&Slow motion"), Qt::CTRL | Qt::Key_Space,
              QStringLiteral("Plays the pass at the selected speed, or pauses"));
  forward_ = add(QStringLiteral("passForward"), QStringLiteral("Step f&orward"), Qt::Key_Period,
                 QStringLiteral("Goes forward by one candidate of the pass"));
  last_ = add(QStringLiteral("passLast"), QStringLiteral("&Last step"), Qt::CTRL | Qt::Key_Period,
              QStringLiteral("Goes to the end of the pass"));
  follow_ = add(QStringLiteral("passFollow"), QStringLiteral("Follow &drag"), Qt::SHIFT | Qt::Key_O,
                QStringLiteral("On: always shows the last pass. Off: keeps the present pass"));
  play_->setCheckable(true);
  follow_->setCheckable(true);
  connect(first_, &QAction::triggered, this, [this] { propagation_.goTo(0); });
  connect(back_, &QAction::triggered, this, [this] { propagation_.stepBy(-1); });
  connect(play_, &QAction::triggered, &propagation_, &Propagation::setPlays);
  connect(forward_, &QAction::triggered, this, [this] { propagation_.stepBy(1); });
  connect(last_, &QAction::triggered, this, [this] { propagation_.goTo(propagation_.stepCount()); });
  connect(follow_, &QAction::triggered, &propagation_, &Propagation::setShowsNewest);
  first_->setIcon(icon("toStart"));
  back_->setIcon(icon("stepBack"));
  forward_->setIcon(icon("stepForward"));
  last_->setIcon(icon("toEnd"));
}

QWidget* PropagationDock::makeButtons() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  for (QAction* action : {first_, back_, play_, forward_, last_}) {
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

QWidget* PropagationDock::makeChoices() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* follow = new QToolButton;
  follow->setDefaultAction(follow_);
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

void PropagationDock::fill(QMenu& menu) {
  auto* steps = menu.addMenu(QStringLiteral("Steps of the p&ass"));
  steps->addActions({first_, back_, play_, forward_, last_});
  steps->addSeparator();
  steps->addAction(follow_);
}

void PropagationDock::refresh() {
  refreshActions();
  for (PropagationColumn* column : columns_) {
    column->refresh();
  }
  emit changed();
}

/// Enables and disables the actions. The tool tip of a disabled action explains why.
void PropagationDock::refreshActions() {
  const bool ready = propagation_.isShown() && propagation_.hasPass();
  const QString why = propagation_.isShown() ? QStringLiteral("no pass yet: drag an element")
                                             : QStringLiteral("open the Propagation dock first (O)");
  for (QAction* action : {first_, back_, play_, forward_, last_, follow_}) {
    const QString name = QString(action->text()).remove(QLatin1Char('&'));
    action->setEnabled(ready);
    action->setToolTip(ready ? QStringLiteral("%1 (%2)").arg(name, action->shortcut().toString())
                             : QStringLiteral("%1: %2").arg(name, why));
  }
  play_->setChecked(propagation_.plays());
  play_->setIcon(icon(propagation_.plays() ? "pause" : "play"));
  follow_->setChecked(propagation_.showsNewest());
}

}  // namespace chainmail

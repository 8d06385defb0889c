#include "window/dock_folds.h"

#include <QEvent>
#include <QMainWindow>
#include <QSettings>
#include <QToolButton>
#include <algorithm>

#include "common/dock_scroll.h"
#include "common/workbench_style.h"
#include "window/dock_layout.h"

namespace chainmail {
namespace {

constexpr int arrowSize = 16;  // pixels

QString arrowName(const QDockWidget& dock) { return dock.objectName() + QStringLiteral("Fold"); }
DockScroll* contentOf(const QDockWidget& dock) { return qobject_cast<DockScroll*>(dock.widget()); }
QString settingsKey(const QDockWidget& dock) { return QStringLiteral("folds/") + dock.objectName(); }

/// Lets Tab reach a button of the title before the content. A new child comes last in the order of the focus.
void focusBeforeContent(QWidget& button, const QDockWidget& dock) {
  QWidgetList content;
  for (QWidget* one = dock.nextInFocusChain(); one != &button; one = one->nextInFocusChain()) {
    if (dock.isAncestorOf(one) && (one->focusPolicy() & Qt::TabFocus) != 0 && one->focusProxy() == nullptr) {
      content << one;
    }
  }
  QWidget* before = &button;
  for (QWidget* one : content) {
    QWidget::setTabOrder(before, one);
    before = one;
  }
}

}  // namespace

void bringUp(QDockWidget& dock) {
  if (auto* arrow = dock.findChild<QToolButton*>(arrowName(dock), Qt::FindDirectChildrenOnly)) {
    arrow->setChecked(false);
  }
  dock.show();
  dock.raise();
}

DockFolds::DockFolds(QMainWindow& window) : window_(window) {
  later_.setSingleShot(true);
  connect(&later_, &QTimer::timeout, this, [this] {
    for (auto& [dock, fold] : folds_) {
      adapt(*dock, fold);
    }
    skipLoneTabs(window_);
  });
}

void DockFolds::follow(QDockWidget& dock) {
  if (contentOf(dock) == nullptr) {
    return;
  }
  auto* arrow = new QToolButton(&dock);
  arrow->setObjectName(arrowName(dock));
  arrow->setAccessibleName(QStringLiteral("Fold the dock %1").arg(dock.windowTitle()));
  arrow->setToolTip(QStringLiteral("Folds this dock to its title, or unfolds it"));
  arrow->setCheckable(true);
  arrow->setAutoRaise(true);
  arrow->setFocusPolicy(Qt::TabFocus);
  focusBeforeContent(*arrow, dock);
  arrow->resize(arrowSize, arrowSize);
  arrow->hide();
  arrow->setChecked(QSettings().value(settingsKey(dock)).toBool());
  Fold& fold = folds_[&dock] = {arrow};
  connect(arrow, &QToolButton::toggled, this, [this, &dock, &fold](bool folded) {
    QSettings().setValue(settingsKey(dock), folded);
    adapt(dock, fold);
  });
  const auto later = [this] { later_.start(); };
  connect(&dock, &QDockWidget::visibilityChanged, this, later);
  connect(&dock, &QDockWidget::dockLocationChanged, this, later);
  connect(&dock, &QDockWidget::topLevelChanged, this, later);
  connect(dock.toggleViewAction(), &QAction::triggered, arrow, [arrow](bool shown) {
    if (shown) {
      arrow->setChecked(false);
    }
  });
  dock.installEventFilter(this);
  later();
}

void DockFolds::unfoldAll() {
  for (auto& [dock, fold] : folds_) {
    fold.arrow->setChecked(false);
  }
}

/// The arrow stays in the middle of the title, which is above the content.
bool DockFolds::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest) {
    auto& dock = static_cast<QDockWidget&>(*watched);
    const int title = contentOf(dock)->isFolded() ? dock.height() : dock.widget()->y();
    folds_.at(&dock).arrow->move(2, std::max(0, (title - arrowSize) / 2));
  }
  return QObject::eventFilter(watched, event);
}

bool DockFolds::canFold(const QDockWidget& dock) const {
  const Qt::DockWidgetArea area = window_.dockWidgetArea(const_cast<QDockWidget*>(&dock));
  const bool atSide = area == Qt::LeftDockWidgetArea || area == Qt::RightDockWidgetArea;
  return atSide && !dock.isFloating() && !dock.isHidden() &&
         std::ranges::all_of(window_.tabifiedDockWidgets(const_cast<QDockWidget*>(&dock)),
                             [](const QDockWidget* other) { return other->isHidden(); });
}

void DockFolds::adapt(QDockWidget& dock, Fold& fold) {
  const bool can = canFold(dock), folded = can && fold.arrow->isChecked();
  fold.arrow->setVisible(can);
  fold.arrow->setArrowType(folded ? Qt::RightArrow : Qt::DownArrow);
  dock.setProperty(WorkbenchStyle::titleIndent, can ? arrowSize : 0);
  dock.update();
  if (folded == contentOf(dock)->isFolded()) {
    return;
  }
  if (folded) {
    fold.height = dock.height();
  }
  contentOf(dock)->setFolded(folded);
  dock.setMaximumHeight(folded ? dock.minimumSizeHint().height() : QWIDGETSIZE_MAX);
  if (!folded && can) {
    window_.resizeDocks({&dock}, {std::max(fold.height, dock.sizeHint().height())}, Qt::Vertical);
  }
}

}  // namespace chainmail

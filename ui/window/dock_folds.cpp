#include "window/dock_folds.h"

#include <QEvent>
#include <QMainWindow>
#include <QSettings>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

#include "common/workbench_style.h"

namespace chainmail {
namespace {

constexpr int arrowSize = 16;  // pixels

QString arrowName(const QDockWidget& dock) { return dock.objectName() + QStringLiteral("Fold"); }
QString settingsKey(const QDockWidget& dock) { return QStringLiteral("folds/") + dock.objectName(); }

}  // namespace

void bringUp(QDockWidget& dock) {
  if (auto* arrow = dock.findChild<QToolButton*>(arrowName(dock), Qt::FindDirectChildrenOnly)) {
    arrow->setChecked(true);
  }
  dock.show();
  dock.raise();
}

void DockFolds::follow(QDockWidget& dock) {
  auto* arrow = new QToolButton(&dock);
  arrow->setObjectName(arrowName(dock));
  arrow->setAccessibleName(QStringLiteral("Content of the dock %1").arg(dock.windowTitle()));
  arrow->setToolTip(QStringLiteral("Shows only the title of this dock, or the whole dock again"));
  arrow->setCheckable(true);
  arrow->setAutoRaise(true);
  arrow->setFocusPolicy(Qt::TabFocus);
  arrow->resize(arrowSize, arrowSize);
  arrow->hide();
  const bool wanted = QSettings().value(settingsKey(dock)).toBool();
  arrow->setChecked(!wanted);
  folds_[&dock] = {arrow, wanted};
  connect(arrow, &QToolButton::toggled, this, [this, &dock](bool whole) { choose(dock, !whole); });
  const auto later = [this] { QTimer::singleShot(0, this, qOverload<>(&DockFolds::adapt)); };
  connect(&dock, &QDockWidget::visibilityChanged, this, later);
  connect(&dock, &QDockWidget::dockLocationChanged, this, later);
  connect(&dock, &QDockWidget::topLevelChanged, this, later);
  connect(dock.toggleViewAction(), &QAction::triggered, arrow, [arrow](bool shown) {
    if (shown) {
      arrow->setChecked(true);
    }
  });
  dock.installEventFilter(this);
  later();
}

void DockFolds::unfoldAll() {
  for (auto& [dock, fold] : folds_) {
    fold.arrow->setChecked(true);
  }
}

/// The arrow stays in the middle of the title, which is above the content.
bool DockFolds::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest) {
    auto& dock = static_cast<QDockWidget&>(*watched);
    const Fold& fold = folds_.at(&dock);
    const int title = fold.folded || dock.widget() == nullptr ? dock.height() : dock.widget()->y();
    fold.arrow->move(2, std::max(0, (title - arrowSize) / 2));
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

void DockFolds::choose(QDockWidget& dock, bool folded) {
  folds_.at(&dock).wanted = folded;
  QSettings().setValue(settingsKey(dock), folded);
  adapt(dock, folds_.at(&dock));
}

void DockFolds::adapt() {
  for (auto& [dock, fold] : folds_) {
    adapt(*dock, fold);
  }
}

void DockFolds::adapt(QDockWidget& dock, Fold& fold) {
  const bool can = canFold(dock), folded = can && fold.wanted;
  fold.arrow->setVisible(can);
  fold.arrow->setArrowType(folded ? Qt::RightArrow : Qt::DownArrow);
  dock.setProperty(WorkbenchStyle::titleIndent, can ? arrowSize : 0);
  dock.update();
  if (folded == fold.folded) {
    return;
  }
  fold.folded = folded;
  if (folded) {
    fold.height = dock.height();
  }
  dock.widget()->setVisible(!folded);
  dock.setMaximumHeight(folded ? dock.minimumSizeHint().height() : QWIDGETSIZE_MAX);
  if (!folded && can) {
    window_.resizeDocks({&dock}, {std::max(fold.height, dock.sizeHint().height())}, Qt::Vertical);
  }
}

}  // namespace chainmail

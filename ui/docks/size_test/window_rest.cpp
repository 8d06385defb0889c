#include "docks/size_test/window_rest.h"

#include <QDockWidget>
#include <QMenu>
#include <QToolBar>

namespace chainmail {

WindowRest::WindowRest(QMainWindow& window, const QWidget& dock, const QStringList& actions) : window_(window) {
  window.setAcceptDrops(false);
  for (QDockWidget* one : window.findChildren<QDockWidget*>()) {
    if (one != &dock) {
      rest(one->widget());  // the dock itself can still be moved and closed
    }
  }
  for (QToolBar* bar : window.findChildren<QToolBar*>()) {
    rest(bar);
  }
  for (QAction* action : window.findChildren<QAction*>()) {
    const bool ofMenu = action->menu() != nullptr;  // submenus still open, so that the user can read their items
    const bool showsDock = qobject_cast<QDockWidget*>(action->parent()) != nullptr;
    if (action->isEnabled() && !ofMenu && !showsDock && !actions.contains(action->objectName()) &&
        !dock.isAncestorOf(qobject_cast<QWidget*>(action->parent()))) {
      action->setEnabled(false);
      actions_.emplace_back(action);
    }
  }
}

void WindowRest::rest(QWidget* widget) {
  if (widget != nullptr && widget->isEnabled()) {
    widget->setEnabled(false);
    widgets_.emplace_back(widget);
  }
}

WindowRest::~WindowRest() {
  for (const auto& action : actions_) {
    if (action != nullptr) {
      action->setEnabled(true);
    }
  }
  for (const auto& widget : widgets_) {
    if (widget != nullptr) {
      widget->setEnabled(true);
    }
  }
  window_.setAcceptDrops(true);
}

}  // namespace chainmail

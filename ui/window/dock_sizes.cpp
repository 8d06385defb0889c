#include "window/dock_sizes.h"

#include <QEvent>
#include <QLayout>
#include <QTimer>
#include <algorithm>

namespace chainmail {

void DockSizes::follow(QDockWidget& dock) {
  docks_.push_back(&dock);
  dock.installEventFilter(this);
}

bool DockSizes::eventFilter(QObject* watched, QEvent* event) {
  auto& dock = static_cast<QDockWidget&>(*watched);
  if (event->type() == QEvent::Resize) {
    noteWidth(dock);
  } else if (event->type() == QEvent::ShowToParent || event->type() == QEvent::HideToParent) {
    adapt(dock, event->type() == QEvent::ShowToParent);
  }
  return QObject::eventFilter(watched, event);
}

/// Keeps the width of a column for the docks that are hidden now.
void DockSizes::noteWidth(QDockWidget& dock) {
  if (dock.isHidden() || dock.isFloating()) {
    return;
  }
  const Qt::DockWidgetArea area = window_.dockWidgetArea(&dock);
  for (QDockWidget* other : docks_) {
    if (other->isHidden() && window_.dockWidgetArea(other) == area) {
      widthWithout_[other] = dock.width();
    }
  }
}

/// Acts after the layout has moved the other docks. A layout that is restored has sizes of its own.
void DockSizes::adapt(QDockWidget& dock, bool shown) {
  if (!window_.isVisible() || !window_.layout()->isEnabled() || dock.isFloating()) {
    return;
  }
  const Qt::DockWidgetArea area = window_.dockWidgetArea(&dock);
  const auto width = widthWithout_.find(&dock);
  if (area == Qt::BottomDockWidgetArea) {
    QTimer::singleShot(0, this, &DockSizes::fitBottom);
  } else if (!shown && width != widthWithout_.end()) {
    QTimer::singleShot(0, this, [this, area, width = width->second] { restoreWidth(area, width); });
  }
}

void DockSizes::restoreWidth(Qt::DockWidgetArea area, int width) {
  if (const QList<QDockWidget*> docks = visibleIn(area); !docks.isEmpty()) {
    window_.resizeDocks({docks.first()}, {width}, Qt::Horizontal);
  }
}

void DockSizes::fitBottom() {
  const QList<QDockWidget*> docks = visibleIn(Qt::BottomDockWidgetArea);
  int height = 0;
  for (const QDockWidget* dock : docks) {
    height = std::max(height, dock->sizeHint().height());
  }
  window_.resizeDocks(docks, QList<int>(docks.size(), height), Qt::Vertical);
}

QList<QDockWidget*> DockSizes::visibleIn(Qt::DockWidgetArea area) const {
  QList<QDockWidget*> visible;
  for (QDockWidget* dock : docks_) {
    if (!dock->isHidden() && !dock->isFloating() && window_.dockWidgetArea(dock) == area) {
      visible << dock;
    }
  }
  return visible;
}

}  // namespace chainmail

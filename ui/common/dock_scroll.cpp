#include "common/dock_scroll.h"

#include <QEvent>
#include <QScrollBar>
#include <algorithm>

#include "common/parameter_row.h"

namespace chainmail {

DockScroll::DockScroll(QWidget* content) {
  setWidget(content);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  content->installEventFilter(this);
  fitWidth();
}

/// Follows the content, whose width may change.
bool DockScroll::eventFilter(QObject* content, QEvent* event) {
  if (event->type() == QEvent::LayoutRequest) {
    fitWidth();
  }
  return QScrollArea::eventFilter(content, event);
}

void DockScroll::fitWidth() {
  setMinimumWidth(std::max(dockWidth, widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width()));
}

void setColumn(QDockWidget& dock, QVBoxLayout& column) {
  column.setSpacing(6);
  column.setContentsMargins(9, 4, 9, 4);
  column.addStretch();
  auto* content = new QWidget;
  content->setLayout(&column);
  dock.setWidget(new DockScroll(content));
}

}  // namespace chainmail

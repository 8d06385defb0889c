#include "dock_scroll.h"

#include <QScrollBar>
#include <algorithm>

#include "parameter_row.h"

namespace chainmail {

DockScroll::DockScroll(QWidget* content) {
  setWidget(content);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setMinimumWidth(std::max(dockWidth, content->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width()));
}

}  // namespace chainmail

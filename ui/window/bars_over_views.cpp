#include "window/bars_over_views.h"

#include <QEvent>
#include <QVBoxLayout>
#include <algorithm>

#include "panels/panel.h"
#include "panels/panel_area.h"

namespace chainmail {
namespace {

constexpr int distance = 6;  // pixels, from the edges of the views and between bars

}  // namespace

BarsOverViews::BarsOverViews(PanelArea& area)
    : QWidget(area.parentWidget()), area_(&area), column_(new QVBoxLayout(this)) {
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(distance);
  column_->setSizeConstraint(QLayout::SetNoConstraint);  // a long sentence does not widen the window
  const auto follow = [this](Panel* panel) { panel->view().installEventFilter(this); };
  area.installEventFilter(this);
  std::ranges::for_each(area.panels(), follow);
  connect(&area, &PanelArea::added, this, follow);
  connect(&area, &PanelArea::arranged, this, &BarsOverViews::place);
  place();
}

void BarsOverViews::add(QWidget& bar) {
  column_->addWidget(&bar);
  bar.installEventFilter(this);
}

bool BarsOverViews::eventFilter(QObject* watched, QEvent* event) {
  const bool ofBar = watched->parent() == this;
  if (ofBar ? event->type() == QEvent::Show : event->type() == QEvent::Resize || event->type() == QEvent::Move) {
    place();
  }
  return QWidget::eventFilter(watched, event);
}

/// Another bar, a longer sentence or a larger font needs more lines.
bool BarsOverViews::event(QEvent* event) {
  const bool handled = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest) {
    place();
  }
  return handled;
}

void BarsOverViews::place() {
  if (area_ == nullptr) {
    return;
  }
  int bottom = 0;
  for (const int panel : area_->inSight()) {
    const View& view = area_->panels()[std::size_t(panel)]->view();
    bottom = std::max(bottom, view.mapTo(parentWidget(), QPoint(0, view.height())).y());
  }
  const QRect whole = area_->geometry().adjusted(distance, distance, -distance, 0);
  const int height = column_->isEmpty() ? 0 : column_->totalHeightForWidth(whole.width());
  setGeometry(whole.left(), bottom - distance - height, whole.width(), height);
  raise();
}

}  // namespace chainmail

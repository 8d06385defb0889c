#include "tools/drag_tool.h"

#include "panels/view.h"

namespace chainmail {

QString DragTool::hint() const {
  return QStringLiteral(
      "Left: drag an element, in all panels  ·  Right: orbit (3D)  ·  Middle: pan  ·  Wheel: zoom  ·  F: fit");
}

void DragTool::hover(View& view, QPointF place) {
  if (busy()) {
    cancel();  // no button is down: the release went elsewhere, for example to a dialog
  }
  const auto point = controlPoints_.at(view, place);
  controlPoints_.mark(point);
  document_.setHighlight({point ? std::nullopt : view.elementAt(place), false, {}});
}

void DragTool::leave(View& /*view*/) {
  if (!point_) {
    controlPoints_.mark({});
  }
}

bool DragTool::pressOnPoint(View& view, QPointF place) {
  point_ = controlPoints_.at(view, place);
  if (point_) {
    start_ = controlPoints_.position(*point_);
    grip_ = view.pointAt(place, start_);
    controlPoints_.mark(point_, true);
    document_.grabControlPoint(point_->point);
  }
  return point_.has_value();
}

void DragTool::press(View& view, QPointF place, Qt::KeyboardModifiers /*modifiers*/) {
  const auto element = view.elementAt(place);
  if (pressOnPoint(view, place) || !element) {
    return;
  }
  if (document_.isPinned(*element)) {
    document_.grab(*element);  // is refused, and the message says why
    return;
  }
  grabbed_ = element;
  start_ = view.position(*element);
  grip_ = view.pointAt(place, start_);
  document_.setHighlight({element, true, {}});
  document_.grab(*element);
}

void DragTool::move(View& view, QPointF place) {
  if (!busy()) {
    return;
  }
  const QVector3D travel = view.pointAt(place, start_) - grip_;
  const Point target = start_ + Point(travel.x(), travel.y(), travel.z());
  grabbed_ ? document_.drag(target) : document_.dragControlPoint(target);
}

void DragTool::release(View& view, QPointF place) {
  if (busy()) {
    cancel();
    hover(view, place);
  }
}

void DragTool::cancel() {
  if (busy()) {
    grabbed_.reset();
    point_.reset();
    document_.release();
  }
  controlPoints_.mark({});
  document_.setHighlight({});
}

}  // namespace chainmail

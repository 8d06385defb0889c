#include "tools/drag_tool.h"

#include "panels/view.h"

namespace chainmail {

QString DragTool::hint() const {
  return QStringLiteral(
      "Left: drag an element, in all panels  ·  Right: orbit (3D)  ·  Middle: pan  ·  Wheel: zoom  ·  F: fit");
}

void DragTool::hover(View& view, QPointF position) {
  if (busy()) {
    cancel();  // no button is pressed: another widget, for example a dialog, received the release
  }
  const auto point = controlPoints_.at(view, position);
  controlPoints_.mark(point);
  document_.setHighlight({point ? std::nullopt : view.elementAt(position), false, {}});
}

void DragTool::leave(View& /*view*/) {
  if (!point_) {
    controlPoints_.mark({});
  }
}

bool DragTool::pressOnPoint(View& view, QPointF position) {
  point_ = controlPoints_.at(view, position);
  if (point_) {
    start_ = controlPoints_.position(*point_);
    grip_ = view.pointAt(position, start_);
    controlPoints_.mark(point_, true);
    document_.grabControlPoint(point_->point);
  }
  return point_.has_value();
}

void DragTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  const auto element = view.elementAt(position);
  if (pressOnPoint(view, position) || !element) {
    return;
  }
  if (document_.isPinned(*element)) {
    document_.grab(*element);  // the document refuses it, and a message gives the reason
    return;
  }
  grabbed_ = element;
  start_ = view.position(*element);
  grip_ = view.pointAt(position, start_);
  document_.setHighlight({element, true, {}});
  document_.grab(*element);
}

void DragTool::move(View& view, QPointF position) {
  if (!busy()) {
    return;
  }
  const QVector3D travel = view.pointAt(position, start_) - grip_;
  const Point target = start_ + Point(travel.x(), travel.y(), travel.z());
  grabbed_ ? document_.drag(target) : document_.dragControlPoint(target);
}

void DragTool::release(View& view, QPointF position) {
  if (busy()) {
    cancel();
    hover(view, position);
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

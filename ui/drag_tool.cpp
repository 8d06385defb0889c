#include "drag_tool.h"

#include "view.h"

namespace chainmail {

QString DragTool::hint() const {
  return QStringLiteral(
      "Left: drag an element, in all panels  ·  Right: orbit (3D)  ·  Middle: pan  ·  Wheel: zoom  ·  F: fit");
}

void DragTool::hover(View& view, QPointF place) {
  if (grabbed_) {
    cancel();  // no button is down: its release went to someone else, a dialog say
  }
  document_.setHighlight({view.elementAt(place), false, {}});
}

void DragTool::press(View& view, QPointF place, Qt::KeyboardModifiers /*modifiers*/) {
  const auto element = view.elementAt(place);
  if (!element) {
    return;
  }
  if (document_.isPinned(*element)) {
    document_.grab(*element);  // refused, and the refusal says why
    return;
  }
  grabbed_ = element;
  start_ = view.position(*element);
  hand_ = view.pointAt(place, start_);
  document_.setHighlight({element, true, {}});
  document_.grab(*element);
}

void DragTool::move(View& view, QPointF place) {
  if (!grabbed_) {
    return;
  }
  const QVector3D travel = view.pointAt(place, start_) - hand_;
  document_.drag(start_ + Point(travel.x(), travel.y(), travel.z()));
}

void DragTool::release(View& view, QPointF place) {
  if (grabbed_) {
    cancel();
    hover(view, place);
  }
}

void DragTool::cancel() {
  if (grabbed_) {
    grabbed_.reset();
    document_.release();
  }
  document_.setHighlight({});
}

}  // namespace chainmail

#include "tools/select_tool.h"

#include <QRectF>
#include <cmath>

#include "drawing/picking.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr double smallestRectangle = 4;  // pixels; a smaller rectangle counts as a click
constexpr int circleCorners = 48;

SelectionMode modeOf(Qt::KeyboardModifiers modifiers) {
  if ((modifiers & Qt::ShiftModifier) != 0) {
    return SelectionMode::add;
  }
  const bool removes = (modifiers & (Qt::ControlModifier | Qt::AltModifier)) != 0;
  return removes ? SelectionMode::remove : SelectionMode::replace;
}

}  // namespace

QString SelectTool::hint() const {
  return QStringLiteral(
      "Left: select elements, also hidden ones  ·  Shift: add  ·  Ctrl or Alt: remove  ·  Esc: deselect all");
}

void SelectTool::setShape(Shape shape) {
  cancel();
  shape_ = shape;
}

void SelectTool::hover(View& view, QPointF position) {
  if (pressed_) {
    cancel();  // no button is pressed: another widget received the release
  }
  document_.highlight().set({});
  at_ = &view;
  const bool shown = !outline_.empty();
  outline_.clear();
  if (shape_ == Shape::brush) {
    outline(position);
  }
  if (shown || !outline_.empty()) {
    view.update();
  }
}

void SelectTool::press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) {
  at_ = &view;
  pressed_ = true;
  mode_ = modeOf(modifiers);
  start_ = last_ = position;
  mesh_ = document_.mesh();
  before_ = document_.selection().elements();
  hit_.clear();
  if (shape_ == Shape::brush) {
    brush(view, QLineF(position, position));
  }
}

void SelectTool::move(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  if (!pressed_ || at_ != &view) {
    return;
  }
  if (shape_ == Shape::brush) {
    brush(view, QLineF(last_, position));
  }
  last_ = position;
  outline(position);
  view.update();
}

void SelectTool::release(View& view, QPointF position) {
  if (!pressed_ || at_ != &view) {
    return;
  }
  move(view, position, {});
  if (shape_ == Shape::rectangle) {
    const QRectF rectangle = QRectF(start_, position).normalized();
    if (std::max(rectangle.width(), rectangle.height()) >= smallestRectangle) {
      hit_ = view.search().elementsWhere(rectangle, [&rectangle](QPointF at) { return rectangle.contains(at); });
    } else if (const auto element = view.search().elementAt(position)) {
      hit_ = {*element};
    }
    document_.selection().set(combined(before_, hit_, mode_));
  }
  pressed_ = false;
  hover(view, position);
}

/// Selects during the stroke, so that the user sees the result.
void SelectTool::brush(View& view, QLineF along) {
  const QRectF bounds = QRectF(along.p1(), along.p2()).normalized().adjusted(-radius_, -radius_, radius_, radius_);
  const auto reached =
      view.search().elementsWhere(bounds, [this, along](QPointF at) { return distanceFrom(along, at) <= radius_; });
  hit_ = combined(hit_, reached, SelectionMode::add);
  document_.selection().set(combined(before_, hit_, mode_));
}

void SelectTool::outline(QPointF position) {
  outline_.clear();
  if (shape_ == Shape::rectangle) {
    outline_ = {start_, {position.x(), start_.y()}, position, {start_.x(), position.y()}, start_};
    return;
  }
  for (int i = 0; i <= circleCorners; ++i) {
    const double angle = 2 * M_PI * i / circleCorners;
    outline_.push_back(position + radius_ * QPointF(std::cos(angle), std::sin(angle)));
  }
}

void SelectTool::cancel() {
  if (pressed_ && shape_ == Shape::brush && document_.mesh() == mesh_) {
    document_.selection().set(before_);
  }
  pressed_ = false;
  at_ = nullptr;
  outline_.clear();
  document_.highlight().set({});
}

void SelectTool::escape() {
  if (!pressed_) {
    document_.selection().set({});
  }
  cancel();
}

void SelectTool::leave(View& view) {
  if (!pressed_ && at_ == &view) {
    outline_.clear();
    view.update();
  }
}

std::span<const QPointF> SelectTool::stroke(const View& view) const {
  return at_ == &view ? std::span<const QPointF>(outline_) : std::span<const QPointF>();
}

}  // namespace chainmail

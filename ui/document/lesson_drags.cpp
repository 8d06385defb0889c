#include "document/lesson_drags.h"

#include <algorithm>
#include <utility>

namespace chainmail {
namespace {

using Box = std::array<Point, 2>;

void include(Box& box, const Point& point) { box = {box[0].cwiseMin(point), box[1].cwiseMax(point)}; }

Point positionIn(const Frame& frame, ElementId element) { return point_of(*frame.mesh, frame.view(), element); }

/// Returns the drag that is under way before a move: its handle, and where it has led so far.
LessonDrag underWay(std::span<const Command> moves, std::size_t from, Point& reached) {
  LessonDrag drag;
  for (std::size_t i = 0; i < from; ++i) {
    if (const auto* grab = std::get_if<commands::Grab>(&moves[i])) {
      drag.elements = grab->elements;
      reached = Point::Zero();
    } else if (const auto* one = std::get_if<commands::Drag>(&moves[i])) {
      reached = one->target;
    }
  }
  return drag;
}

}  // namespace

std::vector<LessonDrag> dragsAmong(std::span<const Command> moves, std::size_t from, std::size_t to) {
  Point before = Point::Zero();
  LessonDrag now = underWay(moves, from, before);
  std::vector<LessonDrag> drags;
  bool begun = false;
  for (const Command& move : moves.subspan(from, to - from)) {
    if (const auto* grab = std::get_if<commands::Grab>(&move)) {
      now.elements = grab->elements;
      before = Point::Zero();
      begun = false;
    } else if (const auto* drag = std::get_if<commands::Drag>(&move)) {
      const Point way = drag->relative ? Point(drag->target - before) : drag->target;
      if (!std::exchange(begun, true)) {
        drags.push_back({now.elements, drag->relative, {way, way}});
      }
      include(drags.back().ways, way);
    }
  }
  return drags;
}

std::vector<Point> cornersOf(std::span<const LessonDrag> drags, const Frame& now) {
  std::vector<Point> corners;
  for (const LessonDrag& drag : drags) {
    Box box{Point::Zero(), Point::Zero()};
    for (const ElementId element : drag.elements) {
      const Point at = drag.relative ? positionIn(now, element) : Point(Point::Zero());
      element == drag.elements.front() ? void(box = {at, at}) : include(box, at);
    }
    box = {box[0] + drag.ways[0], box[1] + drag.ways[1]};
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto side = [&](unsigned k) { return box[corner >> k & 1U][k]; };
      corners.push_back({side(0), side(1), side(2)});
    }
  }
  return corners;
}

}  // namespace chainmail

#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "simulate/command.h"
#include "simulate/frame.h"

namespace chainmail {

/// A recorded drag, or the part of it that belongs to a range of moves.
struct LessonDrag {
  std::vector<ElementId> elements;  // of the handle
  bool relative = false;            // true: `ways` are displacements since the beginning of the range
  std::array<Point, 2> ways{};      // the lowest and highest coordinates of where the moves lead (mesh units)
};

/// Returns the drags among the moves from `from` up to `to`, also the rest of a drag that began before.
std::vector<LessonDrag> dragsAmong(std::span<const Command> moves, std::size_t from, std::size_t to);

/// Returns the corners of a box that contains the handles of the drags everywhere on their ways. `now` shows the object
/// at the beginning of the range.
std::vector<Point> cornersOf(std::span<const LessonDrag> drags, const Frame& now);

}  // namespace chainmail

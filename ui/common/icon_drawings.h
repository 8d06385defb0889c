#pragma once

#include <span>
#include <string_view>

#include "common/colours.h"

namespace chainmail {

/// An icon in a square of 16 units. It has paths to stroke and to fill, and paths to fill or stroke in the colour of a
/// mark in the views.
///
/// A path is a list of commands with absolute coordinates: M x y, L x y, C x1 y1 x2 y2 x y, Z as in SVG; E cx cy rx ry
/// is an ellipse, R x y w h a rectangle, A cx cy r start sweep an arc (degrees, counterclockwise from the right).
struct IconDrawing {
  std::string_view name, lines, fills = {};
  std::string_view marks = {}, markLines = {};
  colours::Colour mark = colours::marked;
  bool dashed = false;  // applies to the lines
};

std::span<const IconDrawing> iconDrawings();

}  // namespace chainmail

#pragma once

#include <QColor>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/colours.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The values that colour an object: one per link or per element.
struct ColourValues {
  MeshPointer mesh;
  bool ofLinks = true;
  std::vector<float> values;
  /// For values of links in space: for each element the one of its links that is furthest from the centre, which
  /// colours the faces. Otherwise empty.
  std::vector<float> atElements;
  /// Range of the values, without those of cut links. `lowest` is greater than `highest` if there are no values.
  float lowest = 0, highest = 0;
  /// Unique number of this set of values; 0 before the first set.
  std::uint64_t number = 0;
};

/// The values at the two ends of the colour map. Values that differ from the centre by at most the threshold are
/// neutral.
struct ColourScale {
  float lowest = 0, highest = -1;
  float threshold = -1;  // -1: no value is neutral
  float centre = 0;
  bool diverging = false;    // true for differences: the centre is in the middle of the map, with a range on each side
  bool logarithmic = false;  // true if equal ratios of values are equally far apart; `lowest` is positive then

  /// True if there are values. They are computed after a panel is painted for the first time.
  bool known() const { return lowest <= highest; }
  bool isNeutral(float value) const { return std::abs(value - centre) <= threshold; }
  bool operator==(const ColourScale&) const = default;
};

}  // namespace chainmail

/// Maps numbers to colours. There is one map for a dark ground (background) and one for a light ground. The contrast
/// with the ground grows with the number. So people with any kind of colour vision see the same order, also in grey
/// prints. The maps end like viridis (Smith and van der Walt 2015): at its bright end on a dark ground, at its dark end
/// on a light one. They begin at a blue, which all eyes tell apart from the grey of neutral values, and stay away from
/// that grey: by at least 21 in CIELAB (CIE 1976), also for eyes without red or green cones as Machado et al. (2009)
/// simulate them. Between the control points, the map is linear in sRGB.
namespace chainmail::colour_map {

using Stops = std::array<std::array<int, 3>, 6>;
const Stops& stops(colours::Ground ground = colours::ground());
/// Returns the map for differences: blue below 0, orange above. People with any kind of colour vision can distinguish
/// the two. The contrast with the ground grows equally on both sides.
const Stops& differenceStops(colours::Ground ground = colours::ground());

/// The colour of values at or below the threshold. It is less visible than any colour of the map, but has a contrast of
/// at least 3 to the ground.
inline constexpr colours::Colour neutral(0xff626a75, 0xff898f99);

/// Returns the colour at a fraction of the range, from lowest (0) to highest (1).
QColor at(double share, colours::Ground ground = colours::ground());
QColor at(double share, const Stops& stops);
const Stops& stopsOf(const ColourScale& scale);
/// Returns where a value is on the map, from 0 to 1.
double shareOf(float value, const ColourScale& scale);
/// Returns the colour of a value.
QColor of(float value, const ColourScale& scale);

}  // namespace chainmail::colour_map

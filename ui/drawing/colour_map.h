#pragma once

#include <QColor>
#include <array>

#include "common/colours.h"
#include "drawing/colour_values.h"

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

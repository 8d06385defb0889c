#pragma once

#include <QColor>
#include <array>

#include "common/colours.h"
#include "drawing/colour_values.h"

/// Maps numbers to colours, with one map per ground (dark, light). All kinds of colour vision, and grey prints, show
/// the same order, because the lightness only moves away from that of the ground. The control points follow viridis
/// (Smith and van der Walt 2015), without its dark end on a dark ground and from its middle down on a light one, so
/// that thin lines are visible everywhere. Between them, the map is linear in sRGB.
namespace chainmail::colour_map {

using Stops = std::array<std::array<int, 3>, 6>;
const Stops& stops(colours::Ground ground = colours::ground());
/// Returns the map for differences: blue below 0, orange above. All kinds of colour vision can distinguish the two, and
/// both move away from the lightness of the ground equally.
const Stops& differenceStops(colours::Ground ground = colours::ground());

/// The colour of values at or below the threshold: it is less visible than any colour of the map.
inline constexpr colours::Colour neutral(0xff505660, 0xffa6acb5);

/// Returns the colour of a share of the range from lowest (0) to highest (1).
QColor at(double share, colours::Ground ground = colours::ground());
QColor at(double share, const Stops& stops);
const Stops& stopsOf(const ColourScale& scale);
/// Returns the colour of a value.
QColor of(float value, const ColourScale& scale);

}  // namespace chainmail::colour_map

#pragma once

#include <QColor>
#include <array>

#include "common/colours.h"
#include "drawing/colour_values.h"

/// Numbers to colours: a map for either ground, read alike with every kind of colour vision and in grey, because its
/// lightness only moves away from the ground's. Between the control points it is linear in sRGB; they follow viridis
/// (Smith and van der Walt 2015): on a dark ground from somewhat further up, on a light one from the middle down, so
/// that a thin line stands out everywhere.
namespace chainmail::colour_map {

using Stops = std::array<std::array<int, 3>, 6>;
const Stops& stops(colours::Ground ground = colours::ground());
/// For differences: blue below 0, orange above, which are told apart with every kind of colour vision; both leave the
/// ground's lightness alike.
const Stops& differenceStops(colours::Ground ground = colours::ground());

/// What lies at or below a threshold has no place on the map, and steps back behind all that has.
inline constexpr colours::Colour neutral(0xff505660, 0xffa6acb5);

/// The colour of a share of the way from the lowest value to the highest.
QColor at(double share, colours::Ground ground = colours::ground());
QColor at(double share, const Stops& stops);
const Stops& stopsOf(const ColourScale& scale);
/// The colour of a value.
QColor of(float value, const ColourScale& scale);

}  // namespace chainmail::colour_map

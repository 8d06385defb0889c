#pragma once

#include <QColor>
#include <array>

/// Numbers to colours: one map, read alike with every kind of colour vision and in grey, because its lightness only
/// grows. Between the control points it is linear in sRGB; they follow viridis (Smith and van der Walt 2015), but begin
/// lighter, so that a thin line stands out from the views' background.
namespace chainmail::colour_map {

inline constexpr std::array<std::array<int, 3>, 6> stops{
    {{88, 80, 168}, {58, 112, 165}, {33, 145, 140}, {53, 183, 121}, {143, 215, 68}, {253, 231, 37}}};

/// What lies at or below a threshold has no place on the map, and steps back behind all that has.
inline const QColor neutral(0x50, 0x56, 0x60);

/// The colour of a share of the way from the lowest value to the highest.
QColor at(double share);

}  // namespace chainmail::colour_map

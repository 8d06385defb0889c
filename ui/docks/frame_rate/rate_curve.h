#pragma once

#include <QPointF>
#include <QPolygonF>
#include <span>
#include <vector>

#include "docks/frame_rate/rate_history.h"

namespace chainmail {

/// The lines of a quantity over time, from a moment on: one for each stretch in which something happened, in seconds
/// and the quantity's unit.
///
/// Where there are more samples than `points` (at least 2), only the lowest and the highest of each piece of time stay,
/// so that a spike is never lost. The pieces are the same from call to call while `from` to `to` is as long.
std::vector<QPolygonF> curveOf(std::span<const RateSample> samples, const RateQuantity& quantity, double from,
                               double to, std::size_t points);

}  // namespace chainmail

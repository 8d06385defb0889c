#pragma once

#include <QLineF>
#include <QPointF>
#include <QRectF>
#include <functional>
#include <optional>
#include <vector>

#include "drawing/projection.h"

namespace chainmail {

// Functions that search in a view. `shown` filters the elements; without it, all elements count. The boxes must be
// those of the same frame, at the level with every element. They let a search skip clusters that are elsewhere in the
// view.

/// Returns the element nearest to a position in the view, at most `reach` logical pixels away. An element in front is
/// preferred to one behind it.
std::optional<ElementId> nearestElement(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                        QPointF position, double reach,
                                        const std::function<bool(ElementId)>& shown = {});

/// Returns the elements for whose position in the view `inside` returns true, ascending. They include elements hidden
/// by others. `bounds` must contain all positions for which `inside` returns true.
std::vector<ElementId> elementsWhere(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                     QRectF bounds, const std::function<bool(QPointF)>& inside,
                                     const std::function<bool(ElementId)>& shown = {});

/// Returns the distance of a position from a segment, which may be a point (pixels).
double distanceFrom(QLineF segment, QPointF position);

/// Returns the uncut links that a stroke crosses in the view, ascending.
std::vector<LinkId> crossedLinks(const Frame& frame, const ClusterBoxes& boxes, const Cuts& cuts,
                                 const Projection& projection, QLineF stroke);

/// Returns the clusters of a level whose elements, links or faces may be visible.
std::vector<std::uint32_t> clustersSeen(const ClusterBoxes& boxes, const Projection& projection);

}  // namespace chainmail

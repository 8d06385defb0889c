#pragma once

#include <QLineF>
#include <QPointF>
#include <QRectF>
#include <functional>
#include <optional>
#include <vector>

#include "drawing/cluster_boxes.h"
#include "drawing/projection.h"

namespace chainmail {

// Searches in a view. `shown` filters the elements; without it, all count. The boxes belong to the same frame, at the
// level with every element, so that clusters elsewhere in the view are skipped.

/// Returns the element nearest to a position in the view, at most `reach` pixels away. An element in front wins over
/// one behind it.
std::optional<ElementId> nearestElement(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                        QPointF position, double reach,
                                        const std::function<bool(ElementId)>& shown = {});

/// Returns the elements, ascending, at whose positions in the view `inside` is true, including hidden ones. It is
/// called for positions in `bounds`.
std::vector<ElementId> elementsWhere(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                     QRectF bounds, const std::function<bool(QPointF)>& inside,
                                     const std::function<bool(ElementId)>& shown = {});

/// Returns the distance of a position from a segment, which may be a point (pixels).
double distanceFrom(QLineF segment, QPointF position);

/// Returns the uncut links, ascending, that a stroke crosses in the view.
std::vector<LinkId> crossedLinks(const Frame& frame, const ClusterBoxes& boxes, const Cuts& cuts,
                                 const Projection& projection, QLineF stroke);

/// Returns the clusters of a level with elements, links or faces that may be visible.
std::vector<std::uint32_t> clustersSeen(const ClusterBoxes& boxes, const Projection& projection);

}  // namespace chainmail

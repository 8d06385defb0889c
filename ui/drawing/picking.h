#pragma once

#include <QLineF>
#include <QPointF>
#include <QRectF>
#include <functional>
#include <optional>
#include <vector>

#include "drawing/cell_boxes.h"
#include "drawing/projection.h"

namespace chainmail {

/// What is where in a view, of the elements that are shown: all, where nothing is said. The boxes are those of the
/// frame, at the level of every element; cells that are out of the way cost nothing.

/// The element nearest to a place of the view within `reach` pixels, where one in front is preferred to
/// one behind.
std::optional<ElementId> nearestElement(const Frame& frame, const CellBoxes& boxes, const Projection& projection,
                                        QPointF place, double reach, const std::function<bool(ElementId)>& shown = {});

/// The elements, ascending, that appear at places for which `inside` holds, those behind others too. It is asked
/// of places in `bounds`.
std::vector<ElementId> elementsWhere(const Frame& frame, const CellBoxes& boxes, const Projection& projection,
                                     QRectF bounds, const std::function<bool(QPointF)>& inside,
                                     const std::function<bool(ElementId)>& shown = {});

/// The distance of a place from a segment, which may be a point (pixels).
double distanceFrom(QLineF segment, QPointF place);

/// The links, ascending and not yet cut, that a stroke crosses in the view.
std::vector<LinkId> crossedLinks(const Frame& frame, const CellBoxes& boxes, const Cuts& cuts,
                                 const Projection& projection, QLineF stroke);

/// The cells of any level some of whose elements, links or faces may be seen.
std::vector<std::uint32_t> cellsSeen(const CellBoxes& boxes, const Projection& projection);

}  // namespace chainmail

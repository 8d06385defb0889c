#pragma once

#include <array>
#include <span>
#include <vector>

#include "drawing/picking.h"
#include "mesh/surface.h"

namespace chainmail {

// Finds the links of the front layer that a stroke crosses: those that are visible, and not those behind them.

using Face = std::array<ElementId, 3>;

/// Returns the triangles of the mesh without a cut side that may appear in a part of the view (logical pixels).
std::vector<Face> wholeFaces(const Frame& frame, const ClusterBoxes& boxes, const Cuts& cuts,
                             const Projection& projection, QRectF part);

/// Appends the faces of a volume's surface.
void appendFaces(const Surface& surface, std::vector<Face>& faces);

/// Returns the crossed links that no face hides where they cross the stroke. A face does not hide its own sides.
std::vector<LinkId> unhiddenLinks(const Frame& frame, const Projection& projection, QLineF stroke,
                                  std::span<const LinkId> crossed, std::span<const Face> faces);

/// Returns the same for an object without faces: the links that are, where they cross the stroke, less than a mean link
/// length behind the nearest element around there.
std::vector<LinkId> nearestLinks(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                 QLineF stroke, std::span<const LinkId> crossed);

}  // namespace chainmail

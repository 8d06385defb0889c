#pragma once

#include <array>
#include <span>
#include <vector>

#include "drawing/picking.h"
#include "mesh/surface.h"

namespace chainmail {

/// What a stroke crosses in the front layer of an object alone: what one sees, and not what is behind it.

using Face = std::array<ElementId, 3>;

/// The mesh's triangles, none of whose sides is cut, that may appear in a part of the view (logical pixels).
std::vector<Face> wholeFaces(const Frame& frame, const CellBoxes& boxes, const Cuts& cuts, const Projection& projection,
                             QRectF part);

/// Adds those of a volume's surface that are in sight.
void appendFaces(const Surface& surface, std::vector<Face>& faces);

/// Of links that cross a stroke those that no face hides where they cross it. A face hides none of its own sides.
std::vector<LinkId> unhiddenLinks(const Frame& frame, const Projection& projection, QLineF stroke,
                                  std::span<const LinkId> crossed, std::span<const Face> faces);

/// The same of an object without faces: those that are, where they cross the stroke, less than a mean link's length
/// behind the nearest element about there.
std::vector<LinkId> nearestLinks(const Frame& frame, const CellBoxes& boxes, const Projection& projection,
                                 QLineF stroke, std::span<const LinkId> crossed);

}  // namespace chainmail

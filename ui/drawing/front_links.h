#pragma once

#include <array>
#include <span>
#include <vector>

#include "drawing/picking.h"
#include "mesh/surface.h"

namespace chainmail {

/// A face in the view. Depths grow with the distance from the eye and are linear along straight lines in the view.
struct SeenFace;

/// The faces in a part of the view, which may hide elements.
class FrontFaces {
 public:
  /// The frame must stay valid.
  FrontFaces(const Frame& frame, const Projection& projection, std::span<const std::array<ElementId, 3>> faces,
             QRectF part);
  ~FrontFaces();
  FrontFaces(const FrontFaces&) = delete;
  FrontFaces& operator=(const FrontFaces&) = delete;

  /// True if a face without this element covers it and is nearer to the eye.
  bool hides(ElementId element) const;
  /// Returns the corner nearest to a position in the view, of the face that is seen there. `shown` filters the corners.
  std::optional<ElementId> cornerAt(QPointF position, const std::function<bool(ElementId)>& shown = {}) const;

 private:
  const Frame& frame_;
  Projection projection_;
  std::vector<SeenFace> faces_;
};

// Functions that find the links of the front layer that a stroke crosses: the visible links, without the links behind
// them.

using Face = std::array<ElementId, 3>;

/// Returns the triangles of the mesh that have no cut side and may appear in `part` of the view (logical pixels).
std::vector<Face> wholeFaces(const Frame& frame, const ClusterBoxes& boxes, const Cuts& cuts,
                             const Projection& projection, QRectF part);

/// Appends the faces of a volume's surface.
void appendFaces(const Surface& surface, std::vector<Face>& faces);

/// Returns the crossed links that no face hides at the point where they cross the stroke. A face does not hide its own
/// sides.
std::vector<LinkId> unhiddenLinks(const Frame& frame, const Projection& projection, QLineF stroke,
                                  std::span<const LinkId> crossed, std::span<const Face> faces);

/// Returns the same for an object without faces. At the crossing, these links are less than 0.75 mean link lengths
/// behind the nearest element near the crossing.
std::vector<LinkId> nearestLinks(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                 QLineF stroke, std::span<const LinkId> crossed);

}  // namespace chainmail

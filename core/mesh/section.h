#pragma once

#include <unordered_map>
#include <vector>

#include "mesh/surface.h"
#include "mesh/texture.h"

namespace chainmail {

/// A plane across an axis of the object at rest. The part in front of it is hidden, to show the inside.
struct SectionPlane {
  /// 0 x, 1 y, 2 z.
  int axis = 0;
  /// Position on the axis (mesh units).
  double at = 0;
  /// True if the hidden part is below the plane instead of above it.
  bool flipped = false;

  /// Returns the distance of a rest position in front of the plane, negative behind it (mesh units).
  double before(const Point& rest) const { return flipped ? at - rest[axis] : rest[axis] - at; }
  bool operator==(const SectionPlane&) const = default;
};

/// Point where a plane crosses the line between two elements, at this share of the way from the first to the second. It
/// moves with the material: it stays between the two.
struct SectionPoint {
  ElementId from = 0, to = 0;
  float share = 0;
};

/// The face that a plane cuts through cells at rest. A hexahedron is cut like its six tetrahedra about the diagonal.
/// Made once per plane and updated under cuts; a frame only needs the positions of its points.
class Section {
 public:
  /// Takes time in proportion to the elements and cells of the mesh.
  Section(CellTablePointer table, const SectionPlane& plane);

  const CellTable& table() const { return *table_; }
  const SectionPlane& plane() const { return plane_; }
  /// The points, each one once.
  const std::vector<SectionPoint>& points() const { return points_; }
  /// Triangles, three points each, of the cells that are whole. Takes time in proportion to the crossed cells.
  std::vector<std::uint32_t> triangles(const Surface& surface) const;

 private:
  void cross(CellId cell, const std::vector<bool>& before);
  void cross_tetrahedron(const std::array<ElementId, 4>& corners, const std::vector<bool>& before);
  std::uint32_t point(ElementId behind, ElementId before);

  CellTablePointer table_;
  SectionPlane plane_;
  std::vector<SectionPoint> points_;
  std::unordered_map<std::uint64_t, std::uint32_t>
      numbers_;                              // of points, by their two elements; used only during construction
  std::vector<CellId> cells_;                // crossed cells
  std::vector<std::uint32_t> first_corner_;  // of each crossed cell, in corners_, and the end
  std::vector<std::uint32_t> corners_;       // of triangles, as indices of points
};

}  // namespace chainmail

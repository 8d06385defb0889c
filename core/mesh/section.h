#pragma once

#include <unordered_map>
#include <vector>

#include "mesh/section_plane.h"
#include "mesh/surface.h"

namespace chainmail {

/// Where a plane meets the line between two elements, at this share of the way
/// from the first to the second. It goes with the material: the place is
/// between the two wherever they are.
struct SectionPoint {
  ElementId from = 0, to = 0;
  float share = 0;
};

/// The face that a plane gives the cells that it crosses at rest. Of a
/// hexahedron it is that of the six tetrahedra about its diagonal. Made once a
/// plane and followed under cuts; a frame needs its points' places alone.
class Section {
 public:
  /// Time: the elements and cells of the mesh.
  Section(CellTablePointer table, const SectionPlane& plane);

  const CellTable& table() const { return *table_; }
  const SectionPlane& plane() const { return plane_; }
  /// Each once.
  const std::vector<SectionPoint>& points() const { return points_; }
  /// Three points each, of the cells that are whole. Time: what the plane
  /// crosses.
  std::vector<std::uint32_t> triangles(const Surface& surface) const;

 private:
  void cross(CellId cell, const std::vector<bool>& before);
  void cross_tetrahedron(const std::array<ElementId, 4>& corners, const std::vector<bool>& before);
  std::uint32_t point(ElementId behind, ElementId before);

  CellTablePointer table_;
  SectionPlane plane_;
  std::vector<SectionPoint> points_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  // of points, by their two elements; while it is made
  std::vector<CellId> cells_;                                 // those crossed
  std::vector<std::uint32_t> first_corner_;                   // of each of them, among corners_, and the end
  std::vector<std::uint32_t> corners_;                        // of triangles, as points
};

}  // namespace chainmail

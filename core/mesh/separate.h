#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "mesh/split.h"

namespace chainmail {

/// The corners of a face or of a piece of one, in order.
using Ring = std::vector<ElementId>;

/// The faces of a mesh: its own triangles, then its polygons.
class Faces {
 public:
  explicit Faces(const Mesh& mesh) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.polygons.size(); i += mesh.polygons[i] + 1) {
      polygons_.push_back(i);
    }
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_.own_triangles + polygons_.size()); }
  bool is_polygon(std::uint32_t face) const { return face >= mesh_.own_triangles; }
  std::uint32_t polygon(std::uint32_t face) const { return face - static_cast<std::uint32_t>(mesh_.own_triangles); }
  std::span<const ElementId> operator[](std::uint32_t face) const {
    if (!is_polygon(face)) {
      return mesh_.triangles[face];
    }
    const std::size_t first = polygons_[polygon(face)];
    return std::span(mesh_.polygons).subspan(first + 1, mesh_.polygons[first]);
  }

 private:
  const Mesh& mesh_;
  std::vector<std::size_t> polygons_;  // where each begins
};

/// Faces that are divided along a stroke.
struct FacesInPieces {
  std::map<std::uint32_t, std::vector<Ring>> pieces;  // convex, by the number of the face
  std::vector<SplitPoint> points;                     // new elements, after those of the mesh
  std::set<EdgeKey> cut;                              // the sides of pieces along which the stroke runs
};

/// Separates divided faces along the sides that are cut. Pieces of triangles become triangles, pieces of polygons stay
/// polygons. Returns an empty edit if nothing comes apart.
SplitEdit separate(const Mesh& mesh, const Faces& faces, const FacesInPieces& divided);

}  // namespace chainmail

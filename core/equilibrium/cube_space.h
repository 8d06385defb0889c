#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// A hierarchy of cubes over the rest shape of an object with cells in space, in which displacements are interpolated.
/// Each cube is divided into six tetrahedra around its main diagonal (Freudenthal 1942), which nest: those of a cube
/// are unions of those of the cubes in it.
///
/// Cells of the object are divided into tetrahedra, and each belongs to the cube with its centre. What is connected
/// inside a cube is a part, with corners of its own; parts of neighbouring cubes share their corners if they share an
/// element (virtual nodes; Molino et al. 2004). So two branches of an object in one cube move independently.
///
/// Lengths are in units of unit(): cubes of level 1 have the width 2, those of level l 2^l. Immutable.
class CubeSpace {
 public:
  static constexpr std::uint32_t none = 0xffffffff;
  using Place = std::array<std::int32_t, 3>;
  using Tetrahedron = std::array<ElementId, 4>;

  /// The cubes of a level are in Morton's order, so that what belongs to those inside a coarser one is a range. What is
  /// listed here ends where that of the next cube begins.
  struct Cube {
    Place at{};
    std::uint32_t parent = none;  // on the next coarser level
    std::uint32_t child = 0;      // the first on the next finer level
    std::uint32_t part = 0, element = 0, skin = 0, tetrahedron = 0;
  };
  struct Part {
    std::uint32_t cube = 0, parent = none;
    std::array<std::uint32_t, 8> corner{};  // ids of nodes; bit k of the index is the side along axis k
    std::array<float, 6> volume{};          // of the object in each of the six tetrahedra
    float all() const { return volume[0] + volume[1] + volume[2] + volume[3] + volume[4] + volume[5]; }
  };
  struct Level {
    std::int32_t width = 1;  // of cubes
    Place size{};            // number of places along each axis
    std::vector<std::uint32_t> cube_at;
    std::vector<Cube> cubes;  // and one behind the last
    std::vector<Part> parts;
    std::vector<std::uint32_t> parts_around;  // of each node
    std::vector<std::uint8_t> is_full;        // of each cube: it is filled, or one beside it is

    std::size_t cube_count() const { return cubes.size() - 1; }
    std::size_t node_count() const { return parts_around.size(); }
    /// Returns the cube at a place, or none.
    std::uint32_t find(const Place& at) const;
  };

  /// Where a point is in a cube: in which of its six tetrahedra, with the weights of its corners. The weights of a
  /// point outside extrapolate.
  struct Interpolation {
    int path = 0;
    std::array<std::uint8_t, 4> corner{};
    std::array<double, 4> weight{};
  };
  /// The axes along which the edges of each of the six tetrahedra go, from corner 0 to corner 7.
  static constexpr std::array<std::array<std::uint8_t, 3>, 6> paths{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  /// The path for x ≥ y (1), x ≥ z (2) and y ≥ z (4).
  static constexpr std::array<int, 8> path_of{5, 4, 2, 1, 3, 0, 2, 0};
  /// The corners of a path's tetrahedron.
  static constexpr std::array<std::uint8_t, 4> corners_of(int path) {
    const auto& p = paths[std::size_t(path)];
    return {0, std::uint8_t(1 << p[0]), std::uint8_t(7 ^ 1 << p[2]), 7};
  }

  /// Leaves out the cells at cut links, unless no others are left. Takes memory in proportion to the cells, however far
  /// apart they are. Throws Cancelled.
  explicit CubeSpace(MeshPointer mesh, const Cuts& cuts = {}, const Progress& progress = {});

  const Mesh& mesh() const { return *mesh_; }
  double unit() const { return unit_; }
  /// Levels 1 to top(), which has one cube. Level 0 are the elements and has no cubes.
  int top() const { return int(levels_.size()) - 1; }
  const Level& level(int l) const { return levels_[std::size_t(l)]; }
  /// How many cubes of level 1 apart the homes of the elements of a cell are at most, and its own cube from them.
  int reach() const { return reach_; }
  /// Longest side of the object (units).
  double extent() const { return extent_; }

  /// True if the object is at least four times as thick as a cube here. Wider cubes are too stiff in bending.
  bool is_thick(int l, std::uint32_t cube) const {
    for (int i = 0; i < 2 && l < top(); ++i) {
      cube = level(l++).cubes[cube].parent;
    }
    return level(l).is_full[cube] != 0;
  }

  std::span<const Tetrahedron> tetrahedra() const;
  /// True if a link along the cell of a tetrahedron is cut.
  bool is_gone(std::uint32_t tetrahedron, const Cuts& cuts) const;
  /// The tetrahedra that are not left out, by their cube of level 1.
  const std::vector<std::uint32_t>& sorted_tetrahedra() const { return sorted_tetrahedra_; }
  /// All elements with cells, and those on the surface, by the cube of level 1 that they belong to.
  const std::vector<ElementId>& sorted_elements() const { return sorted_elements_; }
  const std::vector<ElementId>& sorted_skin() const { return sorted_skin_; }
  /// The rest positions of these (mesh units), in their order: they are written often.
  const std::vector<Point>& rest_of_skin() const { return rest_of_skin_; }
  /// The part of level 1 to which an element belongs, or none without cells. It is in the element's cube if one of the
  /// element's cells is.
  std::uint32_t home(ElementId element) const { return home_[element]; }
  /// The part of another level that contains one of level 1.
  std::uint32_t ancestor(std::uint32_t part, int l) const;
  /// Returns where an element is at rest.
  Point point(ElementId element) const { return point_of(mesh_->rest.data() + std::size_t{element} * 3); }
  Point point_of(const double* rest) const { return (Point::Map(rest) - origin_) * per_unit_; }
  /// Returns the place of level 1 of a point, or the nearest one.
  Place place_of(const Point& point) const;
  Interpolation interpolate(const Point& point, int l, const Cube& cube) const {
    const double steep = 1.0 / double(1 << l);
    const std::array f{point[0] * steep - cube.at[0], point[1] * steep - cube.at[1], point[2] * steep - cube.at[2]};
    const int path =
        path_of[std::size_t(f[0] >= f[1]) | std::size_t(f[0] >= f[2]) << 1 | std::size_t(f[1] >= f[2]) << 2];
    const auto& p = paths[std::size_t(path)];
    return {path, corners_of(path), {1 - f[p[0]], f[p[0]] - f[p[1]], f[p[1]] - f[p[2]], f[p[2]]}};
  }
  /// Calls visit(path, volume) for the shares of a tetrahedron's volume in its cube's six tetrahedra.
  template <class Visit>
  void for_each_share(std::uint32_t tetrahedron, const Cube& cube, Visit visit) const {
    constexpr double near = 0.5854101966249685, far = 0.1381966011250105;  // exact for squares
    const auto corners = points_of(tetrahedron);
    const double share = volume_of(corners) / 4;
    for (std::size_t i = 0; i < 4; ++i) {
      const Point at = far * (corners[0] + corners[1] + corners[2] + corners[3]) + (near - far) * corners[i];
      visit(interpolate(at, 1, cube).path, share);
    }
  }
  std::array<Point, 4> points_of(std::uint32_t tetrahedron) const {
    const Tetrahedron& t = tetrahedra()[tetrahedron];
    return {point(t[0]), point(t[1]), point(t[2]), point(t[3])};
  }
  static double volume_of(const std::array<Point, 4>& corners);

 private:
  using Pair = std::array<std::uint32_t, 2>;  // of parts that share an element

  void find_tetrahedra();
  void find_unit(const Progress& progress);
  void sort_tetrahedra(const Cuts& cuts, const Progress& progress);
  std::vector<std::uint32_t> find_parts(const Progress& progress);
  std::vector<Pair> find_pairs(const std::vector<std::uint32_t>& part_of);
  void find_volumes(const std::vector<std::uint32_t>& part_of, const Progress& progress);
  void find_reach();
  void sort_elements();
  static Level cubes_around(Level& fine);
  static void join_parts(Level& fine, Level& coarse, const std::vector<Pair>& pairs);
  void make_coarser(std::vector<Pair>& pairs);
  static void join_corners(Level& level, const std::vector<Pair>& pairs);
  static void find_full(Level& level);

  MeshPointer mesh_;
  std::vector<Tetrahedron> own_tetrahedra_;              // unless they are those of the mesh
  std::vector<std::array<ElementId, 8>> own_hexahedra_;  // of a lattice without cells
  double unit_ = 1, per_unit_ = 1, extent_ = 1;
  Point origin_ = Point::Zero();  // mesh units
  int reach_ = 1;
  std::vector<Level> levels_;
  std::vector<std::uint32_t> sorted_tetrahedra_;
  std::vector<ElementId> sorted_elements_, sorted_skin_;
  std::vector<Point> rest_of_skin_;
  std::vector<std::uint32_t> home_;
};

}  // namespace chainmail

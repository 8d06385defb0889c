#include "elastic/surface_cells.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "elastic/simplices.h"

namespace chainmail {
namespace {

// A triangle is flat if its area is below this share of its longest edge squared, as in build_simplices.
constexpr double flat_area = 1e-8;

class SurfaceBuilder {
 public:
  SurfaceBuilder(const Mesh& mesh, const Progress& progress) : mesh_(mesh), progress_(progress) {}

  SurfaceCells build() {
    mesh_.triangles.empty() ? add_lattice() : add_faces();
    cells_.first_link.push_back(std::uint32_t(cells_.links.size()));
    find_hinges();
    return std::move(cells_);
  }

 private:
  using Triangle = SurfaceCells::Triangle;

  void add_faces() {
    for (const Triangle& one : mesh_.triangles) {
      progress_.report(cells_.triangles.size(), mesh_.triangles.size());
      add(one, std::array{std::array{one[0], one[1]}, std::array{one[1], one[2]}, std::array{one[2], one[0]}});
    }
  }

  /// The squares across the two axes along which the lattice extends.
  void add_lattice() {
    const auto [width, height, depth] = mesh_.lattice->size;
    const std::array<std::uint32_t, 3> steps{1, width, width * height};
    const int across = width == 1 ? 0 : height == 1 ? 1 : 2;
    const auto u = std::size_t(across == 0 ? 1 : 0), v = std::size_t(across == 2 ? 1 : 2);
    for (std::uint32_t y = 0; y + 1 < mesh_.lattice->size[v]; ++y) {
      for (std::uint32_t x = 0; x + 1 < mesh_.lattice->size[u]; ++x) {
        const ElementId a = y * steps[v] + x * steps[u], b = a + steps[u], c = a + steps[v], d = c + steps[u];
        const std::array sides{std::array{a, b}, std::array{c, d}, std::array{a, c}, std::array{b, d}};
        const bool is_even = (x + y) % 2 == 0;
        add(is_even ? Triangle{a, b, d} : Triangle{a, b, c}, sides);
        add(is_even ? Triangle{a, d, c} : Triangle{b, d, c}, sides);
      }
    }
  }

  template <std::size_t Count>
  void add(const Triangle& corners, const std::array<std::array<ElementId, 2>, Count>& edges) {
    const Point a = mesh_.rest_position(corners[0]), b = mesh_.rest_position(corners[1]) - a,
                c = mesh_.rest_position(corners[2]) - a;
    const double longest = std::max({b.squaredNorm(), c.squaredNorm(), (c - b).squaredNorm()});
    if (!(b.cross(c).norm() / 2 > flat_area * longest)) {
      return;
    }
    cells_.triangles.push_back(corners);
    cells_.first_link.push_back(std::uint32_t(cells_.links.size()));
    for (const auto& [i, j] : edges) {
      if (const auto link = find_link(mesh_, i, j)) {
        cells_.links.push_back(*link);
      }
    }
  }

  /// A side of a triangle.
  struct Side {
    std::array<ElementId, 2> ends;  // ascending
    std::uint32_t triangle;
    std::uint8_t number;
  };

  void find_hinges() {
    std::vector<Side> sides;
    sides.reserve(3 * cells_.triangles.size());
    for (std::uint32_t t = 0; t < cells_.triangles.size(); ++t) {
      for (std::uint8_t k = 0; k < 3; ++k) {
        const ElementId a = cells_.triangles[t][k], b = cells_.triangles[t][(k + 1U) % 3];
        sides.push_back({{std::min(a, b), std::max(a, b)}, t, k});
      }
    }
    std::ranges::stable_sort(sides, {}, &Side::ends);
    for (std::size_t first = 0, next = 1; next < sides.size(); ++next) {
      if (sides[next].ends == sides[first].ends) {
        add_hinge(sides[first], sides[next]);
      } else {
        first = next;
      }
    }
  }

  void add_hinge(const Side& one, const Side& other) {
    const auto corner = [&](const Side& side, unsigned after) {
      return cells_.triangles[side.triangle][(side.number + after) % 3];
    };
    cells_.hinges.push_back({{corner(one, 0), corner(one, 1), corner(one, 2), corner(other, 2)},
                             {one.triangle, other.triangle},
                             {one.number, other.number},
                             corner(one, 0) != corner(other, 0)});
  }

  const Mesh& mesh_;
  const Progress& progress_;
  SurfaceCells cells_;
};

}  // namespace

bool is_surface_in_space(const Mesh& mesh) {
  if (mesh.space_dimension != 3 || mesh.has_cells()) {
    return false;
  }
  return !mesh.triangles.empty() ||
         (mesh.lattice && std::ranges::count_if(mesh.lattice->size, [](auto width) { return width > 1; }) == 2);
}

bool has_material(const Mesh& mesh) { return is_surface_in_space(mesh) || has_solid_cells(mesh); }

SurfaceCells build_surface_cells(const Mesh& mesh, const Progress& progress) {
  return SurfaceBuilder(mesh, progress).build();
}

}  // namespace chainmail

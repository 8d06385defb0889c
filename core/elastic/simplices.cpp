#include "elastic/simplices.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "mesh/cells.h"
#include "mesh/disjoint_sets.h"
#include "mesh/error.h"
#include "mesh/fixed_matrix.h"
#include "mesh/layers.h"
#include "mesh/scattered.h"

namespace chainmail {
namespace {

constexpr std::array<CellEdge, 1> link_edges{{{0, 1}}};
constexpr std::array<CellEdge, 3> triangle_edges{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<CellEdge, 4> square_edges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};

/// Returns true if an uncut link joins two elements. A square or cube of a lattice needs all its links.
bool has_link(const Mesh& mesh, const Cuts& cuts, ElementId a, ElementId b) {
  const auto link = find_link(mesh, a, b);
  return link && !cuts.is_cut(*link);
}

class Builder {
 public:
  /// `cells`: what the links of each cell are noted in, if given. Then cells may be flat or inverted.
  Builder(const Mesh& mesh, const Cuts& cuts, const Progress& progress, CellSimplices* cells = nullptr)
      : mesh_(mesh), cuts_(cuts), progress_(progress), cells_(cells) {
    simplices_.dimension = mesh.space_dimension;
  }

  Simplices build() {
    switch (mesh_.space_dimension) {
      case 1:
        add_bars();
        break;
      case 2:
        mesh_.triangles.empty() ? add_squares() : add_triangles();
        break;
      default:
        mesh_.has_cells() ? add_cells() : add_cubes();
    }
    if (simplices_.corners.empty() && cells_ == nullptr) {
      throw Error("object", "it has no uncut cell, so it cannot resist", "uncut links, or use an object with cells");
    }
    if (cells_ == nullptr) {
      sort_simplices(simplices_.corners, static_cast<std::size_t>(simplices_.dimension) + 1);
    }
    find_shapes();
    return std::move(simplices_);
  }

 private:
  /// Notes the links along these edges of the next cell, and how many simplices it has.
  template <class Edges, class Corners>
  void note_cell(const Edges& edges, const Corners& corners, std::size_t simplices) {
    if (cells_ == nullptr) {
      return;
    }
    cells_->cell_of.insert(cells_->cell_of.end(), simplices, static_cast<std::uint32_t>(cells_->first_link.size()));
    cells_->first_link.push_back(static_cast<std::uint32_t>(cells_->links.size()));
    for (const CellEdge& edge : edges) {
      if (const auto link = find_link(mesh_, corners[static_cast<std::size_t>(edge[0])],
                                      corners[static_cast<std::size_t>(edge[1])])) {
        cells_->links.push_back(*link);
      }
    }
  }

  void add(std::initializer_list<ElementId> corners) { simplices_.corners.insert(simplices_.corners.end(), corners); }

  void add_bars() {
    for (LinkId link = 0; link < mesh_.link_count(); ++link) {
      if (!cuts_.is_cut(link)) {
        note_cell(link_edges, mesh_.links[link], 1);
        add({mesh_.links[link][0], mesh_.links[link][1]});
      }
    }
  }

  void add_triangles() {
    for (const auto& [a, b, c] : mesh_.triangles) {
      if (!is_cut_between(mesh_, cuts_, a, b) && !is_cut_between(mesh_, cuts_, b, c) &&
          !is_cut_between(mesh_, cuts_, c, a)) {
        note_cell(triangle_edges, std::array{a, b, c}, 1);
        add({a, b, c});
      }
    }
  }

  void add_cells() {
    const std::size_t tetrahedra = mesh_.tetrahedra.size(), hexahedra = mesh_.hexahedra.size();
    simplices_.corners.reserve(4 * (tetrahedra + 6 * hexahedra));
    if (cells_ != nullptr) {
      cells_->cell_of.reserve(tetrahedra + 6 * hexahedra);
      cells_->first_link.reserve(tetrahedra + hexahedra + 1);
      cells_->links.reserve(6 * tetrahedra + 12 * hexahedra);
    }
    const Progress progress = progress_.part(0, 0.4);
    for (std::size_t i = 0; const auto& cell : mesh_.tetrahedra) {
      progress.report(i++, mesh_.tetrahedra.size());
      if (is_whole(mesh_, cuts_, cell)) {
        note_cell(tetrahedron_edges, cell, 1);
        add({cell[0], cell[1], cell[2], cell[3]});
      }
    }
    for (const auto& cell : mesh_.hexahedra) {
      if (is_whole(mesh_, cuts_, cell)) {
        add_hexahedron(cell);
      }
    }
  }

  void add_hexahedron(const std::array<ElementId, 8>& cell) {
    note_cell(hexahedron_edges, cell, 6);
    for_each_tetrahedron(mesh_, cell, [this](const auto& one) { add({one[0], one[1], one[2], one[3]}); });
  }

  /// Diagonals alternate, so that the sheet has no preferred direction.
  void add_squares() {
    const auto [width, height, depth] = mesh_.lattice->size;
    for (std::uint32_t y = 0; y + 1 < height; ++y) {
      for (std::uint32_t x = 0; x + 1 < width; ++x) {
        const ElementId a = y * width + x, b = a + 1, c = a + width, d = c + 1;
        if (!has_link(mesh_, cuts_, a, b) || !has_link(mesh_, cuts_, c, d) || !has_link(mesh_, cuts_, a, c) ||
            !has_link(mesh_, cuts_, b, d)) {
          continue;
        }
        note_cell(square_edges, std::array{a, b, d, c}, 2);
        if ((x + y) % 2 == 0) {
          add({a, b, d});
          add({a, d, c});
        } else {
          add({a, b, c});
          add({b, d, c});
        }
      }
    }
  }

  void add_cubes() {
    for_each_cube(*mesh_.lattice, [&](const std::array<ElementId, 8>& cube) {
      if (std::ranges::all_of(hexahedron_edges, [&](const CellEdge& edge) {
            return has_link(mesh_, cuts_, cube[edge[0]], cube[edge[1]]);
          })) {
        add_hexahedron(cube);
      }
    });
  }

  double rest(ElementId element, int axis) const {
    return mesh_.rest[std::size_t{element} * static_cast<std::size_t>(mesh_.space_dimension) + std::size_t(axis)];
  }

  void find_shapes() {
    const int n = simplices_.dimension;
    const std::size_t width = static_cast<std::size_t>(n) + 1, count = simplices_.corners.size() / width;
    simplices_.volumes.reserve(count);
    simplices_.gradients.resize(count * width * static_cast<std::size_t>(n));
    const Progress progress = progress_.part(0.4, 1);
    for (std::size_t s = 0; s < count; ++s) {
      progress.report(s, count);
      find_shape(s);
    }
  }

  void find_shape(std::size_t simplex) {
    const int n = simplices_.dimension;
    const std::span<ElementId> corners =
        std::span(simplices_.corners)
            .subspan(simplex * static_cast<std::size_t>(n + 1), static_cast<std::size_t>(n) + 1);
    auto edges = FixedMatrix<double, 3, 3>::Identity();  // those that exist, one per column
    double longest = 0;
    for (int i = 0; i < n; ++i) {
      double squared = 0;
      for (int k = 0; k < n; ++k) {
        edges(k, i) = rest(corners[static_cast<std::size_t>(i) + 1], k) - rest(corners[0], k);
        squared += edges(k, i) * edges(k, i);
      }
      longest = std::max(longest, std::sqrt(squared));
    }
    const FixedMatrix<double, 3, 3> adjoint = adjugate(edges);
    const double product = determinant(edges, adjoint);
    const double volume = product / (n == 3 ? 6 : n);
    const bool is_without_shape = is_flat(volume, longest, n);
    if (cells_ != nullptr && is_without_shape) {
      simplices_.volumes.push_back(0);
      return;
    }
    check_shape(corners, volume, is_without_shape);
    double* gradients = simplices_.gradients.data() + simplex * static_cast<std::size_t>(n * (n + 1));
    for (int k = 0; k < n; ++k) {
      gradients[k] = 0;
      for (int i = 0; i < n; ++i) {
        gradients[(i + 1) * n + k] = adjoint(i, k) / product;
        gradients[k] -= adjoint(i, k) / product;
      }
    }
    simplices_.volumes.push_back(std::abs(volume));
  }

  /// The cells of a file may have either orientation, but all must have the same.
  void check_shape(std::span<const ElementId> corners, double volume, bool is_without_shape) {
    const std::string where = "the cell of elements " + names(corners);
    if (is_without_shape) {
      throw Error(where, "it is flat, so it cannot resist", "remove it, or mesh the object again");
    }
    const bool has_way_round = simplices_.dimension == 3 && cells_ == nullptr;  // a sheet is the same from behind
    if (has_way_round && orientation_ != 0 && (volume > 0) != (orientation_ > 0)) {
      throw Error(where, "it is inverted: its corners are in the opposite order to those of other cells",
                  "turn such cells with 'chainmail repair', or with Object > Repair in the workbench");
    }
    orientation_ = volume > 0 ? 1 : -1;
  }

  static std::string names(std::span<const ElementId> corners) {
    std::string all;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      all += (i == 0 ? "" : i + 1 == corners.size() ? " and " : ", ") + std::to_string(corners[i]);
    }
    return all;
  }

  const Mesh& mesh_;
  const Cuts& cuts_;
  const Progress& progress_;
  CellSimplices* cells_;
  Simplices simplices_;
  int orientation_ = 0;  // of the cells so far: 1, -1, or 0 before the first
};

}  // namespace

Simplices build_simplices(const Mesh& mesh, const Cuts& cuts, const Progress& progress) {
  return Builder(mesh, cuts, progress).build();
}

void sort_simplices(std::vector<ElementId>& corners, std::size_t width) {
  struct Simplex {
    std::array<ElementId, 4> ascending{}, corners{};  // the first `width` of each
    std::uint64_t key = 0;
  };
  std::vector<Simplex> simplices(corners.size() / width);
  for (std::size_t s = 0; s < simplices.size(); ++s) {
    Simplex& simplex = simplices[s];
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(s * width), width, simplex.corners.begin());
    simplex.ascending = simplex.corners;
    std::ranges::sort(std::span(simplex.ascending).first(width));
    for (const ElementId id : simplex.ascending) {
      simplex.key = scattered(simplex.key ^ id);
    }
  }
  std::ranges::sort(simplices, {}, [](const Simplex& one) { return std::pair(one.key, one.ascending); });
  for (std::size_t s = 0; s < simplices.size(); ++s) {
    std::copy_n(simplices[s].corners.begin(), width, corners.begin() + static_cast<std::ptrdiff_t>(s * width));
  }
}

bool is_flat(double volume, double longest, int dimension) {
  constexpr double least = 1e-8;
  return !(std::abs(volume) > least * std::pow(longest, dimension));
}

bool has_solid_cells(const Mesh& mesh) {
  switch (mesh.space_dimension) {
    case 1:
      return false;
    case 2:
      return mesh.lattice || !mesh.triangles.empty();
    default:
      return mesh.lattice || mesh.has_cells();
  }
}

CellSimplices build_cell_simplices(const Mesh& mesh, const Progress& progress) {
  CellSimplices cells;
  cells.simplices = Builder(mesh, Cuts(), progress, &cells).build();
  cells.first_link.push_back(static_cast<std::uint32_t>(cells.links.size()));
  return cells;
}

namespace {

// Checks whether pins leave a part of an object free to move as a rigid body.

// Pins that are closer to one line or point than this share of the object's size do not hold it.
constexpr double apart_from = 1e-6;

/// Subtracts from the points their component along the line through the origin with direction `unit`. Returns the
/// longest remainder.
Point furthest(const std::vector<Point>& from_first, const Point& unit) {
  Point best = Point::Zero();
  for (const Point& point : from_first) {
    const Point across = point - point.dot(unit) * unit;
    if (across.squaredNorm() > best.squaredNorm()) {
      best = across;
    }
  }
  return best;
}

bool holds(const Mesh& mesh, const std::vector<ElementId>& pins) {
  if (pins.empty() || mesh.space_dimension == 1) {
    return !pins.empty();
  }
  const double size = (mesh.box[1] - mesh.box[0]).norm();
  std::vector<Point> from_first;
  from_first.reserve(pins.size());
  for (const ElementId pin : pins) {
    from_first.push_back(mesh.rest_position(pin) - mesh.rest_position(pins.front()));
  }
  const Point along = furthest(from_first, Point::Zero());
  if (along.norm() <= apart_from * size) {
    return false;
  }
  return mesh.space_dimension == 2 || furthest(from_first, along.normalized()).norm() > apart_from * size;
}

std::string too_few(int dimension) {
  return dimension == 1   ? "no pin holds it"
         : dimension == 2 ? "fewer than two pins at different positions hold it"
                          : "fewer than three pins that do not lie on one line hold it";
}

/// Returns what a user can pin. A closed surface has no boundary.
const char* remedy(const Mesh& mesh) {
  return boundary(mesh).empty() ? "pin its bottom layer, or single elements"
                                : "pin its bottom layer, its boundary, or single elements";
}

}  // namespace

void check_pinned(const Mesh& mesh, std::span<const ElementId> pins) {
  if (pins.empty()) {
    throw Error("object", "nothing pins it, so there is no solution", remedy(mesh));
  }
}

void check_part_held(const Mesh& mesh, ElementId part, const std::vector<ElementId>& pins) {
  if (!holds(mesh, pins)) {
    throw Error("the part of element " + std::to_string(part),
                too_few(mesh.space_dimension) + ", so it has no solution", remedy(mesh));
  }
}

void check_held(const Simplices& simplices, const Mesh& mesh, std::span<const ElementId> pins) {
  check_pinned(mesh, pins);
  DisjointSets parts(mesh.element_count());  // joined by cells
  std::vector<bool> in_cell(mesh.element_count(), false);
  for (std::size_t s = 0; s < simplices.count(); ++s) {
    const auto corners = simplices.corners_of(s);
    for (const ElementId corner : corners) {
      in_cell[corner] = true;
      parts.unite(corners[0], corner);
    }
  }
  std::map<std::size_t, std::vector<ElementId>> pins_of;
  for (const ElementId pin : pins) {
    pins_of[parts.of(pin)].push_back(pin);
  }
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (in_cell[e] && parts.of(e) == e) {
      check_part_held(mesh, e, pins_of[e]);
    }
  }
}

}  // namespace chainmail

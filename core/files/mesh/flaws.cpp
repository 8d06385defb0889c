#include "files/mesh/flaws.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>
#include <vector>

#include "files/formats/seeded_hash.h"
#include "mesh/cells.h"

namespace chainmail {
namespace {

// A face is flat if its area is below this share of its longest edge squared; a cell is flat if its volume is below
// this share of its longest edge cubed. The limit is well above rounding errors and well below a visible area or
// volume.
constexpr double flat_share = 1e-9;

template <std::size_t Size>
std::array<ElementId, Size> sorted(std::array<ElementId, Size> corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

bool names_one_twice(std::span<const ElementId> ascending) {
  return std::adjacent_find(ascending.begin(), ascending.end()) != ascending.end();
}

/// Returns, for each of `count` groups of corners, true if it must be left out. `corners(i)` returns the corners of
/// group i in ascending order.
template <class Corners>
std::vector<bool> left_out(std::size_t count, Corners corners, MeshFlaws& flaws) {
  std::vector<bool> out(count, false);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; ++i) {
    const auto group = corners(i);
    out[i] = names_one_twice(group);
    flaws.collapsed += out[i] ? 1 : 0;
    if (!out[i]) {
      order.push_back(i);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](auto i, auto j) { return std::ranges::lexicographical_compare(corners(i), corners(j)); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (std::ranges::equal(corners(order[i]), corners(order[i - 1]))) {
      out[order[i]] = true;
      ++flaws.doubled;
    }
  }
  return out;
}

template <std::size_t Size>
void leave_out(std::vector<std::array<ElementId, Size>>& groups, MeshFlaws& flaws) {
  const auto out = left_out(
      groups.size(), [&](std::size_t i) { return sorted(groups[i]); }, flaws);
  std::size_t i = 0;
  std::erase_if(groups, [&](const auto& /*group*/) { return out[i++]; });
}

void leave_out_polygons(std::vector<ElementId>& polygons, MeshFlaws& flaws) {
  std::vector<std::size_t> begins;
  std::vector<ElementId> ascending = polygons;  // the corners of each polygon after its count
  for (std::size_t i = 0; i < polygons.size(); i += polygons[i] + 1) {
    begins.push_back(i);
    const auto first = ascending.begin() + std::ptrdiff_t(i) + 1;
    std::sort(first, first + polygons[i]);
  }
  const auto corners = [&](std::size_t i) {
    return std::span<const ElementId>(ascending).subspan(begins[i] + 1, polygons[begins[i]]);
  };
  const auto out = left_out(begins.size(), corners, flaws);
  std::vector<ElementId> kept;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    if (!out[i]) {
      const auto first = polygons.begin() + std::ptrdiff_t(begins[i]);
      kept.insert(kept.end(), first, first + *first + 1);
    }
  }
  polygons = std::move(kept);
}

/// Returns the length of the longest edge.
double longest(std::initializer_list<Point> edges) {
  double length = 0;
  for (const Point& edge : edges) {
    length = std::max(length, edge.stableNorm());
  }
  return length;
}

enum class CellShape { sound, flat, inside_out };

/// Returns the shape of a cell of these edges.
CellShape shape_of(const Point& u, const Point& v, const Point& w) {
  const double volume = u.cross(v).dot(w), length = longest({u, v, w});
  const bool is_flat = !(std::abs(volume) > flat_share * length * length * length);
  return is_flat ? CellShape::flat : volume < 0 ? CellShape::inside_out : CellShape::sound;
}

/// Calls visit(cell, shape) for each tetrahedron, then for each hexahedron.
template <class Visit>
void for_each_cell(const Mesh& mesh, Visit visit) {
  std::uint32_t cell = 0;
  const auto at = [&](ElementId e) { return mesh.rest_position(e); };
  for (const auto& t : mesh.tetrahedra) {
    visit(cell++, shape_of(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]), at(t[3]) - at(t[0])));
  }
  for (const auto& h : mesh.hexahedra) {
    // The determinant of the mean edges along the three axes is about the volume of the hexahedron, with its sign.
    const auto mean = [&](std::array<int, 8> way) {
      Point sum = Point::Zero();
      for (int i = 0; i < 8; i += 2) {
        sum += at(h[way[i + 1]]) - at(h[way[i]]);
      }
      return Point(sum / 4);
    };
    visit(cell++,
          shape_of(mean({0, 1, 3, 2, 4, 5, 7, 6}), mean({0, 3, 1, 2, 4, 7, 5, 6}), mean({0, 4, 1, 5, 2, 6, 3, 7})));
  }
}

void add_words(std::string& words, std::uint64_t count, const char* one, const char* several, const char* behind) {
  if (count > 0) {
    words += (words.empty() ? "" : ", ") + std::to_string(count) + " " + (count == 1 ? one : several) + behind;
  }
}

}  // namespace

void leave_out_flawed(MeshParts& parts, MeshFlaws& flaws) {
  std::erase_if(parts.links, [](const auto& link) { return link[0] == link[1]; });
  leave_out(parts.triangles, flaws);
  leave_out_polygons(parts.polygons, flaws);
  leave_out(parts.tetrahedra, flaws);
  leave_out(parts.hexahedra, flaws);
}

std::vector<ElementId> first_at_position(const Mesh& mesh) {
  const auto dimension = std::size_t(mesh.space_dimension);
  const auto position = [&](ElementId e) { return std::span(mesh.rest).subspan(e * dimension, dimension); };
  // A hash table of elements with open addressing.
  constexpr auto empty = std::numeric_limits<ElementId>::max();
  std::vector<ElementId> table(std::bit_ceil(2 * std::size_t{mesh.element_count()} + 1), empty);
  std::vector<ElementId> first(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    std::array<double, 3> key{};
    std::ranges::transform(position(e), key.begin(), [](double coordinate) { return coordinate + 0.0; });  // -0 is 0
    std::size_t at = SeededHash()(key) % table.size();
    while (table[at] != empty && !std::ranges::equal(position(table[at]), position(e))) {
      at = (at + 1) % table.size();
    }
    first[e] = table[at] = table[at] == empty ? e : table[at];
  }
  return first;
}

std::vector<std::uint32_t> cells_inside_out(const Mesh& mesh) {
  std::vector<std::uint32_t> found;
  for_each_cell(mesh, [&found](std::uint32_t cell, CellShape shape) {
    if (shape == CellShape::inside_out) {
      found.push_back(cell);
    }
  });
  return found;
}

void count_flaws(const Mesh& mesh, MeshFlaws& flaws) {
  const auto at = [&](ElementId e) { return mesh.rest_position(e); };
  for (std::size_t i = 0; i < mesh.own_triangles; ++i) {
    const auto& t = mesh.triangles[i];
    const Point u = at(t[1]) - at(t[0]), v = at(t[2]) - at(t[0]);
    const double length = longest({u, v, v - u});
    flaws.flat += u.cross(v).norm() > flat_share * length * length ? 0 : 1;
  }
  for_each_cell(mesh, [&flaws](std::uint32_t /*cell*/, CellShape shape) {
    flaws.flat += shape == CellShape::flat ? 1 : 0;
    flaws.inverted += shape == CellShape::inside_out ? 1 : 0;
  });
  const auto first = first_at_position(mesh);
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    flaws.coincident += first[e] != e ? 1 : 0;
  }
}

std::string in_words(const MeshFlaws& flaws) {
  std::string out, joined, kept;
  add_words(out, flaws.unused, "unused point", "unused points", "");
  add_words(out, flaws.collapsed, "face or cell", "faces or cells", " with a point used twice or fewer than 3");
  add_words(out, flaws.doubled, "duplicate face or cell", "duplicate faces or cells", "");
  add_words(out, flaws.skipped, "line of an unknown kind", "lines of unknown kinds", "");
  add_words(joined, flaws.divided, "prism, pyramid or second-order cell", "prisms, pyramids or second-order cells",
            " divided into tetrahedra, triangles or lines");
  add_words(joined, flaws.joined, "point", "points", " joined to others within the rounding of the file");
  add_words(kept, flaws.flat, "face or cell is flat", "faces or cells are flat", "");
  add_words(kept, flaws.inverted, "cell is inside out", "cells are inside out", "");
  add_words(kept, flaws.coincident, "element shares its position with another",
            "elements share their position with another", "");
  out += out.empty() ? "" : " left out" + std::string(flaws.unused > 0 ? " (ids count only the other points)" : "");
  for (const std::string& part : {joined, kept}) {
    out += (out.empty() || part.empty() ? "" : "; ") + part;
  }
  return out;
}

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/support.h"

namespace chainmail::test {

struct MeshFamily {
  std::string name;
  MeshPointer mesh;
};

/// The axis about which a plane object rotates; for others any axis.
inline Point axis_across(const Mesh& mesh) {
  return mesh.space_dimension == 3
             ? Point(0.6, 0, 0.8)
             : Point(mesh.has_axis(0) ? 0 : 1, mesh.has_axis(1) ? 0 : 1, mesh.has_axis(2) ? 0 : 1);
}

inline void add_triangle(MeshParts& parts, ElementId a, ElementId b, ElementId c) {
  parts.triangles.push_back({a, b, c});
  parts.links.insert(parts.links.end(), {{a, b}, {b, c}, {c, a}});
}

/// A plane of triangles in which no two links are equal: points are moved from the lattice by up to 0.3, and each
/// square is split along either diagonal. Links are given as triangle edges, most of them twice.
inline MeshPointer jittered_triangles(std::uint32_t width, std::uint32_t height, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  MeshParts parts;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    parts.rest.emplace_back(i % width + uniform(random, -0.3, 0.3), i / width + uniform(random, -0.3, 0.3), 0);
  }
  for (std::uint32_t y = 0; y + 1 < height; ++y) {
    for (std::uint32_t x = 0; x + 1 < width; ++x) {
      const ElementId a = x + width * y, b = a + 1, c = a + width, d = c + 1;
      const bool rising = uniform(random, 0, 1) < 0.5;
      add_triangle(parts, a, b, rising ? d : c);
      add_triangle(parts, rising ? a : b, d, c);
    }
  }
  return build_mesh(std::move(parts));
}

/// A closed surface: rings of triangles between two poles.
inline MeshPointer sphere(std::uint32_t segments, std::uint32_t rings) {
  MeshParts parts;
  parts.rest.emplace_back(0, 0, 3);
  for (std::uint32_t i = 0; i < segments * rings; ++i) {
    const double down = std::numbers::pi * (1 + i / segments) / (rings + 1);
    const double around = 2 * std::numbers::pi * (i % segments) / segments;
    parts.rest.push_back(3 *
                         Point(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)));
  }
  parts.rest.emplace_back(0, 0, -3);
  const auto at = [&](std::uint32_t ring, std::uint32_t segment) { return 1 + ring * segments + segment % segments; };
  for (std::uint32_t s = 0; s < segments; ++s) {
    add_triangle(parts, 0, at(0, s), at(0, s + 1));
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      add_triangle(parts, at(ring, s), at(ring + 1, s), at(ring + 1, s + 1));
      add_triangle(parts, at(ring, s), at(ring + 1, s + 1), at(ring, s + 1));
    }
    add_triangle(parts, at(rings - 1, s), 1 + rings * segments, at(rings - 1, s + 1));
  }
  return build_mesh(std::move(parts));
}

/// Returns the parts of a mesh after `place` was applied to each rest position.
template <class Place>
MeshParts placed(const Mesh& mesh, Place place) {
  MeshParts parts;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    parts.rest.push_back(place(mesh.rest_position(e)));
  }
  parts.links = mesh.links;
  return parts;
}

/// The same mesh with its neighbours listed in a random order.
inline MeshPointer shuffled_neighbours(const Mesh& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  MeshParts parts = placed(mesh, [](const Point& p) { return p; });
  parts.links.clear();
  parts.first_entry = mesh.first_entry;
  parts.neighbours = mesh.neighbours;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const EntryId first = mesh.first_entry[e];
    for (EntryId n = mesh.first_entry[e + 1] - first; n > 1; --n) {
      std::swap(parts.neighbours[first + n - 1], parts.neighbours[first + random() % n]);
    }
  }
  return build_mesh(std::move(parts));
}

/// Two meshes in one object, `apart` from each other. The ids of the second follow those of the first.
inline MeshPointer side_by_side(const Mesh& one, const Mesh& other, const Point& apart) {
  MeshParts parts = placed(one, [](const Point& p) { return p; });
  for (ElementId e = 0; e < other.element_count(); ++e) {
    parts.rest.push_back(other.rest_position(e) + apart);
  }
  for (const auto& [a, b] : other.links) {
    parts.links.push_back({a + one.element_count(), b + one.element_count()});
  }
  return build_mesh(std::move(parts));
}

/// All kinds of meshes, small enough for a list search.
inline std::vector<MeshFamily> families() {
  const auto grid = make_mesh(MeshKind::grid, {6, 5, 1});
  return {
      {"line", make_mesh(MeshKind::line, {12, 1, 1})},
      {"line in 2D", make_mesh(MeshKind::line, {12, 1, 1}, 2)},
      {"line in 3D", make_mesh(MeshKind::line, {12, 1, 1}, 3)},
      {"grid", grid},
      {"fine grid", make_mesh(MeshKind::grid, {5, 6, 1}, {}, 0.1)},
      {"grid in 3D", make_mesh(MeshKind::grid, {5, 5, 1}, 3)},
      {"grid that runs left and down", build_mesh(placed(*grid, [](const Point& p) { return Point(-p); }))},
      {"grid in the xz plane", build_mesh(placed(*grid, [](const Point& p) { return Point(p[0], 2.5, p[1]); }))},
      {"grid in an order of its own", shuffled_neighbours(*grid, 1)},
      {"cloth", make_mesh(MeshKind::cloth, {5, 5, 1})},
      {"cloth in 3D", make_mesh(MeshKind::cloth, {5, 4, 1}, 3)},
      {"block", make_mesh(MeshKind::block, {3, 3, 3})},
      {"tetra", make_mesh(MeshKind::tetra, {3, 3, 3})},
      {"jittered triangles", jittered_triangles(6, 5, 2)},
      {"jittered triangles in an order of their own", shuffled_neighbours(*jittered_triangles(5, 5, 3), 4)},
      {"sphere", sphere(7, 4)},
      {"two parts", side_by_side(*grid, *make_mesh(MeshKind::cloth, {4, 3, 1}), Point(3, 2, 0))},
  };
}

inline MeshPointer mesh_of(std::vector<Point> rest, std::vector<std::array<ElementId, 2>> links,
                           std::optional<int> space = {}) {
  MeshParts parts;
  parts.rest = std::move(rest);
  parts.links = std::move(links);
  parts.space_dimension = space;
  return build_mesh(std::move(parts));
}

/// A plane of triangles in no order: some are there twice, some also from behind, and their corners begin anywhere.
inline MeshPointer repeated_triangles() {
  const MeshPointer plane = jittered_triangles(4, 4, 5);
  MeshParts parts = placed(*plane, [](const Point& p) { return p; });
  for (std::size_t i = plane->triangles.size(); i-- > 0;) {
    const auto [a, b, c] = plane->triangles[i * 7 % plane->triangles.size()];
    add_triangle(parts, b, c, a);
    if (i % 3 == 0) {
      add_triangle(parts, c, b, a);
    }
  }
  return build_mesh(std::move(parts));
}

/// Meshes that files may contain, but that nobody draws.
inline std::vector<MeshFamily> degenerate_families() {
  return {
      {"one element", mesh_of({{1, 2, 0}}, {})},
      {"one element in 3D", mesh_of({{1, 2, 3}}, {}, 3)},
      {"one link", mesh_of({{0, 0, 0}, {2, 0, 0}}, {{0, 1}})},
      {"one link in 3D", mesh_of({{0, 0, 0}, {-1, 2, 0.5}}, {{0, 1}}, 3)},
      {"links of length 0",
       mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}})},
      {"all elements at one point", mesh_of({{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}, {{0, 1}, {1, 2}}, 2)},
      {"coincident elements without a link",
       mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 0, 0}, {0, 0, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}})},
      {"repeated triangles", repeated_triangles()},
  };
}

}  // namespace chainmail::test

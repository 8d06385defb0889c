#pragma once

#include <map>

#include "mesh/cells.h"
#include "mesh/mesh.h"

namespace chainmail::test {

/// A sphere about the origin: an octahedron with each face split into n² triangles, counterclockwise as seen from
/// outside.
inline MeshParts sphere_parts(int n, double radius = 1) {
  MeshParts parts;
  std::map<std::array<int, 3>, ElementId> ids;
  const auto id = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = ids.try_emplace(at, static_cast<ElementId>(parts.rest.size()));
    if (is_new) {
      parts.rest.push_back(radius * Point(at[0], at[1], at[2]).normalized());
    }
    return found->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const std::array sign{octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
    const bool mirrored = sign[0] * sign[1] * sign[2] < 0;
    const auto corner = [&](int i, int j) { return id({sign[0] * i, sign[1] * j, sign[2] * (n - i - j)}); };
    const auto add = [&](ElementId a, ElementId b, ElementId c) {
      parts.triangles.push_back(mirrored ? std::array{a, c, b} : std::array{a, b, c});
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(corner(i, j), corner(i + 1, j), corner(i, j + 1));
        if (i + j + 1 < n) {
          add(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
      }
    }
  }
  add_links_along_edges(parts);
  return parts;
}

/// Returns both objects as one, with the second one moved.
inline MeshParts together(MeshParts one, const MeshParts& other, const Point& by = Point::Zero()) {
  const auto first = static_cast<ElementId>(one.rest.size());
  for (const Point& at : other.rest) {
    one.rest.push_back(at + by);
  }
  for (const auto& [a, b, c] : other.triangles) {
    one.triangles.push_back({first + a, first + b, first + c});
  }
  for (const auto& [a, b] : other.links) {
    one.links.push_back({first + a, first + b});
  }
  return one;
}

inline MeshPointer octahedral_sphere(int n, double radius = 1) { return build_mesh(sphere_parts(n, radius)); }

}  // namespace chainmail::test

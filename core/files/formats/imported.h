#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "files/formats/space.h"
#include "mesh/mesh.h"

namespace chainmail {

/// A mesh as a reader takes it from a file. opened() (files/mesh/open_mesh.h) makes a Mesh of it.
struct ImportedMesh {
  /// `links` holds only the lines of the file: opened() adds the edges of faces and cells.
  MeshParts parts;
  /// Number of points in the file that nothing uses and that the library leaves out.
  std::uint64_t unused = 0;
  /// The space dimension that a comment of the file states.
  std::optional<Stated<int>> space;
  /// True if the reader refuses whatever it does not keep: opened() then keeps every face, and a mesh may have no link.
  bool checked = false;
};

/// Adds a face with these corners, or a link where there are two.
inline void add_face(MeshParts& parts, std::span<const ElementId> corners) {
  if (corners.size() == 2) {
    parts.links.push_back({corners[0], corners[1]});
  } else if (corners.size() == 3) {
    parts.triangles.push_back({corners[0], corners[1], corners[2]});
  } else {
    parts.polygons.push_back(static_cast<ElementId>(corners.size()));
    parts.polygons.insert(parts.polygons.end(), corners.begin(), corners.end());
  }
}

}  // namespace chainmail

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "files/formats/space.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The content of a mesh file. opened() (files/mesh/open_mesh.h) builds a Mesh from it.
struct ImportedMesh {
  /// Elements, faces, cells and links. `parts.links` contains only the lines of the file; opened() adds the edges of
  /// faces and cells.
  MeshParts parts;
  /// Number of unused points in the file that the library leaves out.
  std::uint64_t unused = 0;
  /// Number of faces with fewer than 3 corners.
  std::uint64_t collapsed = 0;
  /// Number of faces and cells that were divided into others, see add_divided().
  std::uint64_t divided = 0;
  /// Number of lines that the format does not have, and that the reader passed over.
  std::uint64_t skipped = 0;
  /// Points this close are one point (share of the largest extent). For formats that list corners by their positions.
  double joins_within = 0;
  /// The space dimension that a comment of the file states.
  std::optional<Stated<int>> space;
  /// True if a file of this format may have points without any link.
  bool may_lack_links = false;
  /// True if the reader itself refuses flawed faces. Then opened() keeps every face.
  bool checked = false;
};

/// Adds a face with these corners, or a link if there are two.
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

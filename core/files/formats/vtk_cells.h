#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "files/formats/vtk_cursor.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Takes cells of legacy VTK over into a mesh, whose points must be there before them.
class VtkCells {
 public:
  /// VTK's numbers of the types of cells.
  enum Type {
    vertex = 1,
    vertices,
    line,
    lines,
    triangle,
    strip,
    polygon,
    pixel,
    quad,
    tetrahedron,
    voxel,
    hexahedron
  };

  using Corners = std::span<const std::uint64_t>;

  /// `cursor` says where it is in the file.
  VtkCells(MeshParts& parts, const VtkCursor& cursor) : parts_(parts), cursor_(cursor) {}

  /// Throws Error where the corners are not those of the type, or it is of no use.
  void add(Corners corners, int type);

 private:
  void add_chain(Corners corners);
  void add_face(Corners corners);
  template <std::size_t Size>
  void add_group(std::vector<std::array<ElementId, Size>>& groups, Corners corners, const std::array<int, Size>& order);
  ElementId id(std::uint64_t point) const;

  MeshParts& parts_;
  const VtkCursor& cursor_;
};

}  // namespace chainmail

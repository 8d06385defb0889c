#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "files/formats/divided_cells.h"
#include "files/formats/imported.h"

namespace chainmail {

/// Adds cells of VTK to a mesh that already has its points.
class VtkCells {
 public:
  /// VTK's numbers of the cell types.
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
    hexahedron,
    wedge,
    pyramid,
    line3 = 21,
    triangle6,
    quadrangle8,
    tetrahedron10,
    hexahedron20,
    prism15,
    pyramid13,
    quadrangle9,
    hexahedron27,
    prism18 = 32
  };

  using Corners = std::span<const std::uint64_t>;

  explicit VtkCells(ImportedMesh& mesh) : mesh_(mesh), parts_(mesh.parts) {}

  /// Adds a cell. Throws Error, whose place is empty, if the corners do not fit the type, or if the type is not
  /// supported.
  void add(Corners corners, int type);

 private:
  void add_chain(Corners corners);
  void add_face(Corners corners);
  template <std::size_t Size>
  void add_group(std::vector<std::array<ElementId, Size>>& groups, Corners corners, const std::array<int, Size>& order);
  /// `order` says which corner of VTK is each of Gmsh's, where they differ.
  void add_divided_cell(DividedKind kind, Corners corners, std::span<const int> order = {});
  ElementId id(std::uint64_t point) const;

  ImportedMesh& mesh_;
  MeshParts& parts_;
};

/// The corners of cells: cell i has the corners ids[first[i] .. first[i + 1]).
struct CellRows {
  std::vector<std::uint64_t> first{0};
  std::vector<std::uint64_t> ids;

  std::size_t count() const { return first.size() - 1; }
  VtkCells::Corners operator[](std::size_t i) const {
    return VtkCells::Corners(ids).subspan(first[i], first[i + 1] - first[i]);
  }
};

}  // namespace chainmail

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
  /// VTK's numbers of the cell types that have a counterpart here.
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

  explicit VtkCells(ImportedMesh& mesh) : mesh_(mesh), parts_(mesh.parts) {}

  /// Adds a cell. Throws Error, whose place is empty, if the corners do not fit the type, or if the type is not
  /// supported.
  void add(Corners corners, int type);

 private:
  void add_chain(Corners corners);
  void add_face(Corners corners);
  template <std::size_t Size>
  void add_group(std::vector<std::array<ElementId, Size>>& groups, Corners corners, const std::array<int, Size>& order);
  void add_divided_cell(Corners corners, int type);
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

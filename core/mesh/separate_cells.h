#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/cells.h"
#include "mesh/split.h"

namespace chainmail {

/// A tetrahedron near the blade: a cell, or one of the six that a hexahedron stands for.
struct NearTetrahedron {
  CellId cell = 0;
  std::array<ElementId, 4> corner{};
  std::array<bool, 4> is_beyond{};  // true for corners on the other side of the blade than the first
  bool has_sides = true;            // false where the stroke ends inside

  bool operator==(const NearTetrahedron&) const = default;
};

/// A part of a tetrahedron or of a face, or all of it.
template <std::size_t Corners>
struct SimplexPiece {
  std::uint32_t of = 0;  // index of the tetrahedron, or number of the face: see Faces
  std::array<ElementId, Corners> corner{};
};

/// Cells that are divided along a blade, and faces on them. All their neighbours at elements on the blade are among
/// them, most of them as one piece.
struct CellsInPieces {
  std::vector<NearTetrahedron> tetrahedra;  // ascending by cell; all six of a hexahedron
  std::vector<SimplexPiece<4>> cells;       // ascending by tetrahedron
  std::vector<SimplexPiece<3>> faces;       // ascending by face
  std::vector<SplitPoint> points;           // new elements, after those of the mesh; all on the blade
  std::vector<std::uint8_t> is_on_blade;    // of the elements of the mesh
};

/// Separates divided cells along the blade. Returns an empty edit if nothing comes apart.
SplitEdit separate(const Mesh& mesh, CellsInPieces divided);

}  // namespace chainmail

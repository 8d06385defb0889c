#pragma once

#include <cstdint>
#include <optional>

#include "body/positions.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Returns the number of cells that are turned inside out, or flat: a tetrahedron whose volume no longer has the sign
/// that it has at rest, a hexahedron with such a corner, and in a plane a face. None for an object that has no such
/// cells: a surface in space has no inside.
std::optional<std::uint64_t> inverted_cells(const Mesh& mesh, const PositionView& positions);

/// Returns the largest principal stretch of any cell: the largest factor by which a direction in it is lengthened,
/// which is the largest singular value of its deformation gradient. 1 for an object at rest or moved rigidly. Cells are
/// tetrahedra, the corners of hexahedra, or faces; on a line, and without cells and faces, it is none. Cells that are
/// flat at rest do not count.
std::optional<double> largest_principal_stretch(const Mesh& mesh, const PositionView& positions);

/// Returns the volume of a deformed object (mesh units to the power 3): of its cells, or of what its faces enclose. In
/// a plane it is the area of its faces. Cells and faces count with the sign that they have at rest: a part that is
/// turned inside out counts negative. None for an object without cells and faces, and for faces in space that are not
/// closed. Cells with a cut link are gone and do not count; faces do.
std::optional<double> volume_of(const Mesh& mesh, const PositionView& positions, const Cuts& cuts = {});

/// Figures about the cells of an object, without those that have a cut link. The quality of a hexahedron is that of the
/// tetrahedra for which it stands: see for_each_tetrahedron.
struct CellFigures {
  std::uint64_t cells = 0;
  std::uint64_t parts = 0;                // of the object: no uncut link joins them
  double rest_volume = 0, volume = 0;     // at rest and now, see volume_of
  std::optional<double> worst_quality{};  // at rest, see tetrahedron_quality; none if all cells are gone
};

/// Returns the figures about the cells of an object; none for an object without cells.
std::optional<CellFigures> cell_figures(const Mesh& mesh, const Cuts& cuts, const PositionView& positions);

/// Returns the change of the volume, relative to that at rest: −0.1 if a tenth is lost. None where volume_of has none,
/// or if the volume at rest is 0.
std::optional<double> volume_change(const Mesh& mesh, const PositionView& positions, const Cuts& cuts = {});

}  // namespace chainmail

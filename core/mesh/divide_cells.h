#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "mesh/split.h"
#include "mesh/stroke_in_view.h"

namespace chainmail {

/// A crossing this close to the end of an edge, as a share of the edge, goes through the end.
inline constexpr double cell_snap_share = 0.2;
/// No piece of a cell is worse than this at rest, or than its cell, if that is worse: the blade goes through more
/// elements there. See tetrahedron_quality. Cubes in six tetrahedra have 0.72.
inline constexpr double least_piece_quality = 0.15;

/// Returns the edit that cuts the cells of a mesh along a stroke. The stroke and the line of sight span a blade. Cells
/// that the blade crosses are divided, and cells that share a divided edge; then elements on the blade are doubled,
/// except where the cut ends inside the object (Bielser and Gross 2000; Steinemann et al. 2006; Wu et al. 2015). Total
/// volume stays the same. Where the stroke crosses an edge an even number of times, it does not cut it: a bend within
/// one cell, or the crossing of the stroke with itself, stays uncut.
///
/// A hexahedron with a divided edge, with parts on both sides, or with half a side open becomes tetrahedra: see
/// for_each_tetrahedron. Other hexahedra stay; their sides agree with the new tetrahedra, because the diagonal of a
/// side depends on its own corners alone.
///
/// With `reached`, which is ascending, the blade crosses only edges of cells with one of these links.
///
/// The edit is empty if nothing comes apart. Takes one pass over all elements and two over all cells, and beyond it
/// time in proportion to the cells at the stroke.
SplitEdit divide_cells(const Mesh& mesh, std::span<const ViewPlace> places, std::span<const Eigen::Vector2d> stroke,
                       std::optional<std::span<const LinkId>> reached = {});

}  // namespace chainmail

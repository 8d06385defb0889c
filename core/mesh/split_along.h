#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "mesh/split.h"
#include "mesh/stroke_in_view.h"

namespace chainmail {

/// A crossing this close to the end of a side, as a share of the side, goes through the end: no new side is shorter.
inline constexpr double snap_share = 0.05;
/// The cut ends inside a face only if its end is this far from all sides, as a share of the height; otherwise at the
/// nearest side or corner.
inline constexpr double tip_share = 0.1;

/// Returns the edit that cuts a mesh along a stroke: its cells, as divide_cells does, or its faces if it has none. Of
/// faces, it appends elements where the stroke crosses their sides and where it begins and ends inside one, divides the
/// faces along the stroke, and then separates them: elements on the stroke are doubled, except where the cut ends
/// inside the object. Total area stays the same. With `reached`, which is ascending, a face is divided only between
/// crossings of these links. The edit is empty if nothing comes apart.
SplitEdit split_along(const Mesh& mesh, std::span<const ViewPlace> places, std::span<const Eigen::Vector2d> stroke,
                      std::optional<std::span<const LinkId>> reached = {});

}  // namespace chainmail

#pragma once

#include <cstddef>
#include <vector>

#include "body/softness.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solver/deformer.h"

namespace chainmail {

/// The valid region that an element at its current position gives to a neighbour.
struct NeighbourRegion {
  ElementId neighbour = 0;
  LinkId link = 0;
  /// Lowest and highest corner of the valid region along its axes (mesh units). On axes that do not exist
  /// both are the constant coordinate.
  Point low = Point::Zero(), high = Point::Zero();
  /// The axes in whose coordinates the two corners are.
  RegionAxes axes = {};
  /// Position of the neighbour (mesh units).
  Point at = Point::Zero();
  /// Nearest point of the region; equal to the position if that is inside.
  Point nearest = Point::Zero();
  /// True if the link is valid, up to rounding (counts_as_violated).
  bool inside = true;

  /// Returns a corner in the world: at the high end of axis k if bit k of i is set.
  Point corner(int i) const {
    return axes.into_world(
        {(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]});
  }
};

/// Returns the valid regions of an element's neighbours, in their order, without those behind cut links; at most
/// `at_most`. Computed in double.
std::vector<NeighbourRegion> neighbour_regions(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                               const PositionView& position, ElementId about, std::size_t at_most);

}  // namespace chainmail

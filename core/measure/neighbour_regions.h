#pragma once

#include <cstddef>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/softness.h"
#include "solve/solver.h"

namespace chainmail {

/// Where a neighbour of an element may lie as the element stands, and whether it does.
struct NeighbourRegion {
  ElementId neighbour = 0;
  LinkId link = 0;
  /// Lowest and highest corner of the valid region (mesh units). On axes that the scene does not carry both are the
  /// constant coordinate.
  Point low = Point::Zero(), high = Point::Zero();
  /// Where the neighbour stands (mesh units).
  Point at = Point::Zero();
  /// The place in the region that is nearest to it; the same where it lies in the region.
  Point nearest = Point::Zero();
  /// Whether the link holds, but for rounding (counts_as_violated).
  bool inside = true;
};

/// The valid regions about an element of its neighbours, links that are cut left out, in the neighbours' order; of
/// the first `at_most` of them. Computed in double, whatever the solver uses.
std::vector<NeighbourRegion> neighbour_regions(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                               const PositionView& position, ElementId about, std::size_t at_most);

}  // namespace chainmail

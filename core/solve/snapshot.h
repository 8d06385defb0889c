#pragma once

#include <memory>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Where the elements of an object stand, coordinate by coordinate as a solver holds them, so that it, or another of
/// its mesh and precision, takes them back to the bit. A plain value, which knows neither blocks nor scalars.
struct Snapshot {
  /// Held are displacements from rest, as Exact ChainMail has them; else positions (mesh units both).
  bool from_rest = false;
  /// first, end, first, end… of the runs of elements that are given, ascending. All others stand at rest.
  std::vector<ElementId> runs;
  /// Of each element of the runs, space_dimension coordinates.
  std::vector<double> held;

  bool operator==(const Snapshot&) const = default;
};

/// Positions as a solver holds them, to be given back to it, or to another of its mesh and precision, to the bit. What
/// is kept at different times shares the blocks that did not change between.
struct PositionBlocks {
  /// One a block of ElementBlocks; none where all elements of the block stand at rest.
  std::vector<std::shared_ptr<const void>> blocks;
  bool from_rest = false;
};

}  // namespace chainmail

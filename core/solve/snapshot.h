#pragma once

#include <memory>
#include <vector>

#include "mesh/mesh.h"
#include "solve/positions.h"

namespace chainmail {

/// Positions of an object, as a solver stores them. The same solver, or another of the same mesh and precision,
/// restores them to the bit. A plain value that knows neither blocks nor scalars.
struct Snapshot {
  /// True if `held` are displacements from rest, as Exact ChainMail stores them; otherwise positions (mesh units).
  bool from_rest = false;
  /// Runs of elements that are given, ascending: first, end, first, end… All others are at rest.
  std::vector<ElementId> runs;
  /// space_dimension coordinates for each element of the runs.
  std::vector<double> held;

  bool operator==(const Snapshot&) const = default;
};

/// Throws Error, with the reason, if a snapshot does not fit the mesh or has coordinates beyond position_limit.
void check(const Snapshot& snapshot, const Mesh& mesh, Precision precision);

/// Positions as a solver stores them, in shared blocks: what is saved at different times shares the blocks that did not
/// change in between. The same solver, or another of the same mesh and precision, restores them to the bit.
struct PositionBlocks {
  /// One entry per block of ElementBlocks; null if all elements of the block are at rest.
  std::vector<std::shared_ptr<const void>> blocks;
  bool from_rest = false;
};

}  // namespace chainmail

#pragma once

#include <memory>
#include <vector>

#include "body/positions.h"
#include "body/region_axes.h"
#include "body/softness.h"
#include "mesh/element_blocks.h"
#include "mesh/mesh.h"
#include "mesh/split.h"

namespace chainmail {

/// An object without its positions: what all solvers of an object share.
struct ObjectState {
  MeshPointer mesh = {};
  std::vector<LinkId> cuts = {};     // ascending
  std::vector<ElementId> pins = {};  // ascending
  std::shared_ptr<const Softness> softness = std::make_shared<const Softness>();
};

/// Positions of an object, as a body stores them. The same body, or another of the same mesh and precision, restores
/// them to the bit.
///
/// They are in shared blocks of ElementBlocks::block_elements elements: snapshots that are taken one after another
/// share the blocks that did not change in between.
struct Snapshot {
  /// space_dimension coordinates for each element of a block; null if all its elements are at rest.
  using Block = std::shared_ptr<const std::vector<double>>;

  /// True if the coordinates are displacements from rest, as Exact ChainMail stores them; otherwise positions (mesh
  /// units).
  bool from_rest = false;
  /// One for each block of the mesh; or none if all elements are at rest.
  std::vector<Block> blocks;
  /// The axes whose coordinates they are.
  RegionAxes axes = {};

  bool is_at_rest() const;
  /// Returns the blocks with an element that may be away from rest.
  ElementBlocks away(const Mesh& mesh) const;

  /// Compares the coordinates, not the blocks.
  bool operator==(const Snapshot& other) const;
};

/// The same positions, without blocks: for files.
struct PositionRuns {
  bool from_rest = false;
  /// Runs of elements that are given, ascending: first, end, first, end… All others are at rest.
  std::vector<ElementId> runs;
  /// space_dimension coordinates for each element of the runs.
  std::vector<double> held;
  /// The axes whose coordinates they are.
  RegionAxes axes = {};

  bool operator==(const PositionRuns&) const = default;
};

PositionRuns runs_of(const Snapshot& snapshot, const Mesh& mesh);
/// Rounds coordinates to the precision. Throws Error, with the reason, if the runs do not fit the mesh or have
/// coordinates beyond position_limit.
Snapshot snapshot_of(const PositionRuns& positions, const Mesh& mesh, Precision precision);

/// Throws Error, with the reason, if a snapshot does not fit the mesh or has coordinates beyond position_limit.
void check(const Snapshot& snapshot, const Mesh& mesh, Precision precision);

/// Returns the object after a split; for cuts and pins see mesh/split.h. A link on an old one has the softness of that
/// one. A link inside a face has the mean softness of the links on which it ends, if one of them has its own.
ObjectState object_after(const Split& split, const ObjectState& object);
/// The same without the mesh: it needs no mesh if no link is cut or has a softness of its own.
ObjectState meshless_after(const Split& split, const ObjectState& object);

/// Returns the positions after a split. New elements are between their elements, as they are at rest.
Snapshot positions_after(const Split& split, const Snapshot& positions, Precision precision);

}  // namespace chainmail

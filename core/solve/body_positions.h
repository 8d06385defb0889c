#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "mesh/element_blocks.h"
#include "solve/body.h"
#include "solve/snapshot.h"

namespace chainmail {

/// Returns the positions of these blocks as a snapshot.
template <class Scalar, int Dimension>
Snapshot snapshot_of(const Body<Scalar, Dimension>& body, const ElementBlocks& away) {
  Snapshot result;
  result.from_rest = body.from_rest;
  away.for_each_run([&](ElementId first, ElementId end) {
    result.runs.insert(result.runs.end(), {first, end});
    for (ElementId e = first; e < end; ++e) {
      result.held.insert(result.held.end(), body.positions[e].at, body.positions[e].at + Dimension);
    }
  });
  return result;
}

/// Restores the positions of a snapshot. Rounds them if one of snapshot and body stores displacements and the other
/// positions.
template <class Scalar, int Dimension>
void restore_snapshot(Body<Scalar, Dimension>& body, const Snapshot& snapshot) {
  auto held = snapshot.held.begin();
  for (std::size_t i = 0; i < snapshot.runs.size(); i += 2) {
    for (ElementId e = snapshot.runs[i]; e < snapshot.runs[i + 1]; ++e) {
      for (int k = 0; k < Dimension; ++k, ++held) {
        const double rest = body.mesh->rest[std::size_t{e} * Dimension + k];
        const double shift = snapshot.from_rest == body.from_rest ? -0.0 : snapshot.from_rest ? rest : -rest;
        body.positions[e][k] = static_cast<Scalar>(*held + shift);  // −0 changes no number
      }
    }
  }
}

/// Moves a run of elements to rest.
template <class Scalar, int Dimension>
void put_to_rest(Body<Scalar, Dimension>& body, ElementId first, ElementId end) {
  for (ElementId e = first; e < end; ++e) {
    for (int k = 0; k < Dimension; ++k) {
      body.set_position(e, k, body.mesh->rest[std::size_t{e} * Dimension + k]);
    }
  }
}

/// Content of one block of PositionBlocks.
template <class Scalar, int Dimension>
using PositionBlock = std::array<Position<Scalar, Dimension>, ElementBlocks::block_elements>;

/// Saves these blocks in `kept`. No element outside `away` may be away from rest.
template <class Scalar, int Dimension>
void save_blocks(const Body<Scalar, Dimension>& body, const ElementBlocks& blocks, const ElementBlocks& away,
                 PositionBlocks& kept) {
  kept.blocks.resize(away.block_count());
  kept.from_rest = body.from_rest;
  blocks.for_each_block([&](std::size_t block, ElementId first, ElementId end) {
    kept.blocks[block].reset();
    if (away.contains_block(block)) {
      const auto positions = std::make_shared<PositionBlock<Scalar, Dimension>>();
      std::copy(body.positions.begin() + first, body.positions.begin() + end, positions->begin());
      kept.blocks[block] = positions;
    }
  });
}

/// Restores the positions of one block, which were stored as displacements from rest or absolute.
template <class Scalar, int Dimension>
void take_block(Body<Scalar, Dimension>& body, const PositionBlock<Scalar, Dimension>& positions, ElementId first,
                ElementId end, bool from_rest) {
  for (ElementId e = first; e < end; ++e) {
    body.positions[e] = positions[e - first];
    for (int k = 0; k < Dimension && from_rest != body.from_rest; ++k) {
      const double rest = body.mesh->rest[std::size_t{e} * Dimension + k];
      const double held = positions[e - first][k];
      body.positions[e][k] = static_cast<Scalar>(from_rest ? held + rest : held - rest);
    }
  }
}

/// Restores these blocks. All other blocks must be unchanged since they were saved.
template <class Scalar, int Dimension>
void restore_blocks(Body<Scalar, Dimension>& body, const PositionBlocks& kept, const ElementBlocks& blocks) {
  blocks.for_each_block([&](std::size_t block, ElementId first, ElementId end) {
    if (const auto* positions = static_cast<const PositionBlock<Scalar, Dimension>*>(kept.blocks[block].get())) {
      take_block(body, *positions, first, end, kept.from_rest);
    } else {
      put_to_rest(body, first, end);
    }
  });
}

}  // namespace chainmail

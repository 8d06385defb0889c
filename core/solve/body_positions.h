#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "mesh/element_blocks.h"
#include "solve/body.h"
#include "solve/snapshot.h"

namespace chainmail {

/// Where the elements of these blocks stand.
template <class Scalar, int Dimension>
Snapshot placement_of(const Body<Scalar, Dimension>& body, const ElementBlocks& away) {
  Snapshot result;
  result.from_rest = body.from_rest;
  away.for_each_run([&](ElementId first, ElementId end) {
    result.runs.insert(result.runs.end(), {first, end});
    for (ElementId e = first; e < end; ++e) {
      result.held.insert(result.held.end(), body.places[e].at, body.places[e].at + Dimension);
    }
  });
  return result;
}

/// Puts the elements of a placement where they stood; what is held otherwise now is rounded.
template <class Scalar, int Dimension>
void place_elements(Body<Scalar, Dimension>& body, const Snapshot& placement) {
  auto held = placement.held.begin();
  for (std::size_t i = 0; i < placement.runs.size(); i += 2) {
    for (ElementId e = placement.runs[i]; e < placement.runs[i + 1]; ++e) {
      for (int k = 0; k < Dimension; ++k, ++held) {
        const double rest = body.mesh->rest[std::size_t{e} * Dimension + k];
        const double shift = placement.from_rest == body.from_rest ? -0.0 : placement.from_rest ? rest : -rest;
        body.places[e][k] = static_cast<Scalar>(*held + shift);  // −0 changes no number
      }
    }
  }
}

/// Puts a run of elements where they rest.
template <class Scalar, int Dimension>
void put_to_rest(Body<Scalar, Dimension>& body, ElementId first, ElementId end) {
  for (ElementId e = first; e < end; ++e) {
    for (int k = 0; k < Dimension; ++k) {
      body.place(e, k, body.mesh->rest[std::size_t{e} * Dimension + k]);
    }
  }
}

/// What PositionBlocks holds of a block.
template <class Scalar, int Dimension>
using PlaceBlock = std::array<Place<Scalar, Dimension>, ElementBlocks::block_elements>;

/// Brings these blocks of `kept` up to date; no element outside `away` may stand away from rest.
template <class Scalar, int Dimension>
void keep_places(const Body<Scalar, Dimension>& body, const ElementBlocks& blocks, const ElementBlocks& away,
                 PositionBlocks& kept) {
  kept.blocks.resize(away.block_count());
  kept.from_rest = body.from_rest;
  blocks.for_each_block([&](std::size_t block, ElementId first, ElementId end) {
    kept.blocks[block].reset();
    if (away.contains_block(block)) {
      const auto places = std::make_shared<PlaceBlock<Scalar, Dimension>>();
      std::copy(body.places.begin() + first, body.places.begin() + end, places->begin());
      kept.blocks[block] = places;
    }
  });
}

/// Takes places that were held as displacements from rest, or absolute, as the body holds them now.
template <class Scalar, int Dimension>
void take_places(Body<Scalar, Dimension>& body, const PlaceBlock<Scalar, Dimension>& places, ElementId first,
                 ElementId end, bool from_rest) {
  for (ElementId e = first; e < end; ++e) {
    body.places[e] = places[e - first];
    for (int k = 0; k < Dimension && from_rest != body.from_rest; ++k) {
      const double rest = body.mesh->rest[std::size_t{e} * Dimension + k];
      const double held = places[e - first][k];
      body.places[e][k] = static_cast<Scalar>(from_rest ? held + rest : held - rest);
    }
  }
}

/// Takes these blocks back; all others must stand as they were kept.
template <class Scalar, int Dimension>
void restore_places(Body<Scalar, Dimension>& body, const PositionBlocks& kept, const ElementBlocks& blocks) {
  blocks.for_each_block([&](std::size_t block, ElementId first, ElementId end) {
    if (const auto* places = static_cast<const PlaceBlock<Scalar, Dimension>*>(kept.blocks[block].get())) {
      take_places(body, *places, first, end, kept.from_rest);
    } else {
      put_to_rest(body, first, end);
    }
  });
}

}  // namespace chainmail

#pragma once

#include "mesh/element_blocks.h"
#include "solve/body.h"
#include "solve/placement.h"

namespace chainmail {

/// Where the elements of these blocks stand.
template <class Scalar, int Dimension>
Placement placement_of(const Body<Scalar, Dimension>& body, const ElementBlocks& away) {
  Placement result;
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
void place_elements(Body<Scalar, Dimension>& body, const Placement& placement) {
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

}  // namespace chainmail

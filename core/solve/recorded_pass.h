#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/softness.h"
#include "solve/solver.h"
#include "solve/trace.h"

namespace chainmail {

/// What a pass depends on beside where elements stand.
struct PassConditions {
  Cuts cuts;
  std::vector<ElementId> pins;  // ascending
  Softness softness;
};

/// One pass, as it can be looked at step by step. An element is updated at most once a pass: where all stood before,
/// and where each updated one stood after, is every state between. At step k the grabbed element stands at its
/// target, and the first k candidates of the trace have been taken.
struct RecordedPass {
  MeshPointer mesh;
  Algorithm algorithm = Algorithm::natural_queue;
  std::uint64_t number = 0;  // the how manieth of its simulation
  ElementId grabbed = 0;
  std::shared_ptr<const PassConditions> conditions;
  /// Element by element, space_dimension coordinates each (mesh units).
  std::vector<float> before;
  Trace trace;
  /// Where the grabbed element stood after the pass, then those of the trace, row by row (mesh units).
  std::vector<float> after;

  std::size_t step_count() const { return trace.size(); }
  /// Where an element stood before (mesh units).
  std::span<const float> place_before(ElementId element) const { return place(before, element); }
  /// Where the element of a row stood after.
  std::span<const float> place_after(std::size_t row) const { return place(after, row + 1); }
  std::span<const float> grabbed_after() const { return place(after, 0); }

 private:
  std::span<const float> place(const std::vector<float>& places, std::size_t i) const {
    const auto coordinates = static_cast<std::size_t>(mesh->space_dimension);
    return std::span(places).subspan(i * coordinates, coordinates);
  }
};

}  // namespace chainmail

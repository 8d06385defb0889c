#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "body/algorithm.h"
#include "body/softness.h"
#include "body/trace.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Everything except positions that a pass depends on.
struct PassConditions {
  Cuts cuts;
  std::vector<ElementId> pins;  // ascending
  std::shared_ptr<const Softness> softness;
};

/// One pass that can be replayed step by step. An element is updated at most once per pass, so the positions of all
/// elements before it and those of the updated elements after it give every state between. At step k the handle is
/// at its target, and the first k candidates of the trace have been taken.
struct RecordedPass {
  MeshPointer mesh;
  Algorithm algorithm = Algorithm::natural_queue;
  std::uint64_t number = 0;       // index of the pass in its simulation, from 1
  std::uint64_t in_drag = 0;      // index of the pass in its drag, from 1
  std::vector<ElementId> handle;  // ascending
  std::shared_ptr<const PassConditions> conditions;
  /// Positions of all elements before the pass, space_dimension coordinates each (mesh units). They may be about
  /// another point than the origin, because an object far from it would lose digits.
  std::vector<float> before;
  Trace trace;
  /// Positions after the pass: the elements of the handle, then the element of each row of the trace (mesh units).
  std::vector<float> after;

  std::size_t step_count() const { return trace.size(); }
  /// Position of an element before the pass (mesh units).
  std::span<const float> position_before(ElementId element) const { return position(before, element); }
  /// Position of the element of a row after the pass.
  std::span<const float> position_after(std::size_t row) const { return position(after, handle.size() + row); }
  /// Position of element number i of the handle after the pass.
  std::span<const float> handle_after(std::size_t i) const { return position(after, i); }

 private:
  std::span<const float> position(const std::vector<float>& positions, std::size_t i) const {
    const auto coordinates = static_cast<std::size_t>(mesh->space_dimension);
    return std::span(positions).subspan(i * coordinates, coordinates);
  }
};

}  // namespace chainmail

#pragma once

#include <vector>

#include "core/families.h"
#include "simulate/simulation.h"

namespace chainmail::test {

inline void carry_out(Simulation& simulation, const Command& command) { simulation.apply(command); }

/// Exchanges the state of the object with a kept state, like undo and redo.
inline void exchange(Simulation& simulation, commands::StateId state) {
  constexpr commands::StateId before = 1'000'000, after = before + 1;
  carry_out(simulation, commands::KeepState{before});
  carry_out(simulation, commands::RestoreState{state});
  carry_out(simulation, commands::KeepState{after});
  carry_out(simulation, commands::RestoreState{before});
  carry_out(simulation, commands::KeepState{state});
  carry_out(simulation, commands::RestoreState{after});
  carry_out(simulation, commands::DropState{before});
  carry_out(simulation, commands::DropState{after});
}

inline std::vector<double> positions_of(const Simulation& simulation) {
  return positions_of(simulation.deformer(), simulation.mesh());
}

inline Point position_of(const Simulation& simulation, ElementId element) {
  return position_of(simulation.deformer(), simulation.mesh(), element);
}

/// Grabs an element and drags it from its position.
inline void drag_by(Simulation& simulation, ElementId element, const Point& by) {
  carry_out(simulation, commands::Grab{element});
  carry_out(simulation, commands::Drag{position_of(simulation, element) + by});
}

/// Everything that a command may change and that a user may see.
struct SavedState {
  explicit SavedState(const Simulation& simulation)
      : mesh(simulation.mesh_pointer()),
        positions(positions_of(simulation)),
        cuts(simulation.body().cuts().links()),
        softness(simulation.softness()),
        grabbed(simulation.grabbed().begin(), simulation.grabbed().end()),
        algorithm(simulation.statistics().algorithm),
        passes(simulation.statistics().passes),
        relaxing(simulation.statistics().relaxing),
        valid(simulation.valid()) {}

  /// Returns true for the same object: mesh, positions to the bit, cuts and softness.
  bool same_object(const SavedState& other) const {
    return mesh == other.mesh && same_bits(positions, other.positions) && cuts == other.cuts &&
           softness == other.softness;
  }
  bool operator==(const SavedState& other) const {
    return same_object(other) && grabbed == other.grabbed && algorithm == other.algorithm && passes == other.passes &&
           relaxing == other.relaxing && valid == other.valid;
  }

  MeshPointer mesh;
  std::vector<double> positions;
  std::vector<LinkId> cuts;
  Softness softness;
  std::vector<ElementId> grabbed;
  Algorithm algorithm;
  std::uint64_t passes;
  bool relaxing;
  bool valid;
};

}  // namespace chainmail::test

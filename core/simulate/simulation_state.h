#pragma once

#include <map>
#include <memory>

#include "simulate/command.h"
#include "solver/deformer.h"

namespace chainmail {

/// An object with its positions, as a simulation keeps it for undo.
struct KeptState : ObjectState {
  Snapshot positions = {};
  bool valid = true;  // see Simulation::valid()
};

/// The state of a simulation, without its algorithm and statistics, from which another simulation can continue. It is a
/// value that shares large constant data, and may be moved to another thread.
struct SimulationState {
  KeptState object;
  std::map<commands::StateId, KeptState> kept;
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  std::shared_ptr<const Handle> grabbed;      // null: nothing is grabbed
  std::shared_ptr<const Handle> last_handle;  // of the last pass, if any
};

}  // namespace chainmail

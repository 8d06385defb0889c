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

/// A state that is kept until undo may need it: the splits that lead to its mesh, not the mesh.
class UndoState {
 public:
  explicit UndoState(KeptState state) : mesh_(state.mesh), state_(std::move(state)) { state_.mesh.reset(); }

  KeptState state() const {
    KeptState result = state_;
    result.mesh = mesh_.mesh();
    return result;
  }

 private:
  MeshSource mesh_;
  KeptState state_;
};

/// The state of a simulation, without its algorithm and statistics, from which another simulation can continue. It is a
/// value that shares large constant data, and may be moved to another thread.
struct SimulationState {
  KeptState object;
  std::map<commands::StateId, UndoState> kept;
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  std::shared_ptr<const Handle> grabbed;      // null: nothing is grabbed
  std::shared_ptr<const Handle> last_handle;  // of the last pass, if any
};

}  // namespace chainmail

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "simulate/command.h"
#include "solver/deformer.h"

namespace chainmail {

/// The state of an object.
struct ObjectState {
  MeshPointer mesh;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  std::shared_ptr<const Softness> softness;
  Snapshot positions;
  bool valid = true;
};

/// The state of a simulation, without its algorithm and statistics, from which another simulation can continue. It is a
/// value that shares large constant data, and may be moved to another thread.
struct SimulationState {
  ObjectState object;
  std::map<commands::StateId, ObjectState> kept;  // snapshots for undo
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  std::shared_ptr<const Handle> grabbed;      // null: nothing is grabbed
  std::shared_ptr<const Handle> last_handle;  // of the last pass, if any
};

}  // namespace chainmail

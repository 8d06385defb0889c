#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "simulate/command.h"
#include "solve/solver.h"

namespace chainmail {

/// An object as it stands.
struct ObjectState {
  MeshPointer mesh;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  std::shared_ptr<const Softness> softness;
  PositionBlocks positions;
  bool valid = true;
};

/// All of a simulation but its algorithm and its figures, from which another one goes on. A value that shares what is
/// large and never changes: it may go to another thread.
struct Handover {
  ObjectState object;
  std::map<commands::StateId, ObjectState> kept;  // for undo
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  std::optional<ElementId> grabbed;
  std::optional<ElementId> last_moved;  // the element of the last pass
};

}  // namespace chainmail

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/snapshot.h"
#include "solve/softness.h"
#include "solve/solver.h"

namespace chainmail {

/// Everything that changes a simulation is one of these. They are values: they can be logged, sent to
/// several simulations and replayed.
namespace commands {

/// The hand takes hold of an element; nothing moves yet.
struct Grab {
  ElementId element = 0;
};
/// The grabbed element goes to a target (mesh units): one pass.
struct Drag {
  Point target = Point::Zero();
};
/// The hand lets go.
struct Release {};
/// What is set is shared: a slider's gesture on links with a softness of their own copies none of them.
struct SetSoftness {
  SetSoftness(std::shared_ptr<const Softness> set = std::make_shared<const Softness>()) : softness(std::move(set)) {}
  explicit SetSoftness(Softness set) : SetSoftness(std::make_shared<const Softness>(std::move(set))) {}

  std::shared_ptr<const Softness> softness;
};
/// Relaxation in idle time, with a step in (0, 1].
struct SetRelaxation {
  bool on = false;
  double step = 1;
  RelaxationScheme scheme = RelaxationScheme::mean;

  bool operator==(const SetRelaxation&) const = default;
};
/// Sweeps of relaxation at once, up to this many, whether it is on or off, with a step in (0, 1].
struct Relax {
  std::uint32_t sweeps = 1;
  double step = 1;
  RelaxationScheme scheme = RelaxationScheme::mean;
};
/// What methods of elasticity and free-form deformation go by.
struct SetElastic {
  ElasticOptions options;
};
/// Puts a control point of free-form deformation somewhere (mesh units).
struct MoveControlPoint {
  std::uint32_t point = 0;
  Point target = Point::Zero();
};
struct SetAlgorithm {
  Algorithm algorithm = Algorithm::natural_queue;
};
struct Cut {
  std::vector<LinkId> links;
};
struct Uncut {
  std::vector<LinkId> links;
};
/// These elements may not move from where they are. The element in the hand cannot be pinned.
struct Pin {
  std::vector<ElementId> elements;
};
struct Unpin {
  std::vector<ElementId> elements;
};
/// Back to the rest positions; cuts, pins and softness stay.
struct Reset {};
/// Another object, uncut, unpinned, at rest, by Natural Queue where the algorithm does not work on it; softness per
/// link goes, the global one stays.
struct ReplaceMesh {
  MeshPointer mesh;
};

/// Puts elements where they are said to stand. It must be a placement of this mesh.
struct Place {
  std::shared_ptr<const Snapshot> placement;
};

/// Names a state that a simulation keeps for undo.
using StateId = std::uint64_t;
/// Keeps the object as it is now (mesh, cuts, pins, softness, positions) under a name.
struct KeepState {
  StateId state = 0;
};
/// Brings the object to the state kept under a name, which stays kept.
struct RestoreState {
  StateId state = 0;
};
/// Forgets a kept state.
struct DropState {
  StateId state = 0;
};

}  // namespace commands

using Command =
    std::variant<commands::Grab, commands::Drag, commands::Release, commands::SetSoftness, commands::SetRelaxation,
                 commands::Relax, commands::SetAlgorithm, commands::Cut, commands::Uncut, commands::Pin,
                 commands::Unpin, commands::Reset, commands::ReplaceMesh, commands::Place, commands::KeepState,
                 commands::RestoreState, commands::DropState, commands::SetElastic, commands::MoveControlPoint>;

}  // namespace chainmail

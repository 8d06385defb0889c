#pragma once

#include <memory>
#include <string>
#include <vector>

#include "api/access.h"
#include "body/body.h"
#include "body/snapshot.h"
#include "solver/solver.h"

namespace chainmail::api {

/// A body as values, without its mesh.
struct BodyState {
  inner::Precision precision = inner::Precision::double_precision;
  bool works_in_axes = true;
  bool stores_displacements = false;
  std::shared_ptr<const Softness> softness = std::make_shared<const Softness>();
  ElasticOptions elastic = {};
  std::vector<LinkId> cuts = {};
  std::vector<ElementId> pins = {};
  inner::Snapshot positions = {};
  inner::Body::Reach reach = {};
  std::vector<ElementId> handle = {};  // of the last move since positions were set
  bool is_held = false;                // the handle was not released
};

/// What a deformer knows besides its body.
struct DeformerState {
  std::string method;
  bool is_tracing = false;
  std::vector<TraceStep> trace = {};  // of the last move
  SolverMemory memory = {};
};

ElementBlocks every_block(const inner::Mesh& mesh);
inner::Snapshot snapshot_of(const inner::Body& body);

BodyState state_of(const Body& body);
/// Makes a body whose next moves are, bit for bit, those of the one that had this state. The state fits the mesh.
Body body_of(const Mesh& mesh, const BodyState& state);
/// Throws Error if a state, which may come from outside, does not fit a mesh.
void check(const BodyState& state, const inner::Mesh& mesh);

/// Returns what a deformer of a copy of the body needs in order to continue as this one does, bit for bit. The next
/// move of this one may have to prepare again. Throws Error for a method that was registered.
inline DeformerState hand_over(Deformer& deformer) { return Access::hand_over(deformer); }
/// Continues as the deformer that handed this over. Throws Error if the state does not fit the body.
inline void take_over(Deformer& deformer, const DeformerState& state) { Access::take_over(deformer, state); }

}  // namespace chainmail::api

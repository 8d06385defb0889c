#include "solver/elastic_deformation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "body/body_view.h"
#include "elastic/methods.h"
#include "mesh/error.h"
#include "solver/algorithms.h"

namespace chainmail {
namespace {

std::vector<double> pin_displacements(const Body& body) {
  return displacements_of(body.mesh(), body.positions(), body.pins());
}

/// Returns a handle in the coordinates that exist. The motion of one element is its displacement from rest.
ElasticHandle elastic_handle(const Mesh& mesh, const Handle& handle) {
  if (handle.has_one()) {
    return ElasticHandle::of(handle.elements()[0]);
  }
  ElasticHandle result;
  result.elements.assign(handle.elements().begin(), handle.elements().end());
  for (std::size_t i = 0; i < result.elements.size(); ++i) {
    const Point displacement = handle.target(i, {}) - mesh.rest_position(result.elements[i]);
    for (int k = 0; k < mesh.space_dimension; ++k) {
      result.displacements.push_back(displacement[mesh.axes[std::size_t(k)]]);
      result.arms.push_back(handle.arm(i)[mesh.axes[std::size_t(k)]]);
    }
  }
  return result;
}

/// Returns true if a solver could be updated to other cuts.
bool is_updated(ElasticSolver& solver, const Cuts& cuts, const Progress& progress) {
  auto* update = dynamic_cast<CutUpdate*>(&solver);
  return update != nullptr && update->recut(cuts, progress);
}

// Largest rotation in one step of a method that depends on the path (radians).
constexpr double largest_turn = 0.25;

}  // namespace

ElasticMotion elastic_motion(const Mesh& mesh, const RigidMotion& motion) {
  const int n = mesh.space_dimension;
  ElasticMotion result{SmallMatrix(n, n), SmallVector(n)};
  for (int row = 0; row < n; ++row) {
    const int axis = mesh.axes[std::size_t(row)];
    result.translation[row] = motion.translation[axis];
    for (int column = 0; column < n; ++column) {
      result.turn(row, column) = motion.turn(axis, mesh.axes[std::size_t(column)]);
    }
  }
  return result;
}

PassCount ElasticDeformation::move(Body& body, HandleMove& move, PassOutput output) {
  std::array<double, 3> displacement{};  // of a handle of one element
  body.with_view([&]<class View>(const View& view) {
    for_each_target(view, move, [&](ElementId element, const Position<typename View::Scalar, View::Dimension>& target) {
      for (int k = 0; k < View::Dimension; ++k) {
        displacement[std::size_t(k)] =
            double(target[k]) - view.mesh->rest[std::size_t{element} * View::Dimension + std::size_t(k)];
      }
    });
  });
  prepare(body, output.progress);
  hold(body, move.handle, output.progress);
  if (move.handle.has_one()) {
    const auto dimension = std::size_t(body.mesh().space_dimension);
    solver_->move(ElasticMotion::by(std::span(displacement).first(dimension)), output.progress);
  } else {
    move_rigidly(body.mesh(), move, output.progress);
  }
  check_answer(body);
  return take_answer(body, move.handle.elements(), output.moved);
}

/// A method that depends on the path follows a rotation in steps: on a straight line, the handle would shrink. If a
/// step does not converge, the handle has the pose of the one before.
void ElasticDeformation::move_rigidly(const Mesh& mesh, HandleMove& move, const Progress& progress) {
  const Pose from = move.handle.pose(), target = std::exchange(move.pose, from);
  const double angle = angle_between(from.rotation, target.rotation);
  const int steps = solver_->follows_path() ? std::max(1, int(std::ceil(angle / largest_turn))) : 1;
  for (int step = 1; step <= steps; ++step) {
    const double share = double(step) / steps;
    const Pose to = step == steps ? target
                                  : Pose{from.pivot + share * (target.pivot - from.pivot),
                                         rotation_between(from.rotation, target.rotation, share)};
    solver_->move(elastic_motion(mesh, move.handle.motion(to)), progress.part(double(step - 1) / steps, share));
    if (!solver_->reached()) {
      return;
    }
    move.pose = to;
  }
}

void ElasticDeformation::hold(const Body& body, const Handle& handle, const Progress& progress) {
  const Grab grab{handle.elements()[0], handle.grab()};
  if (held_ != grab) {
    held_ = {};
    solver_->hold(elastic_handle(body.mesh(), handle), progress);
    held_ = grab;
  }
}

/// The parts of a body that a preparation depends on.
Revisions ElasticDeformation::revisions_of(const Body& body) {
  return body.revisions().only({&Revisions::cuts, &Revisions::pins, &Revisions::elastic});
}

std::uint64_t ElasticDeformation::positions_of(const Body& body) {
  return body.revisions().positions + body.revisions().relaxed;
}

void ElasticDeformation::prepare(const Body& body, const Progress& progress) {
  const Revisions revisions = revisions_of(body);
  const std::uint64_t positions = positions_of(body);
  const bool knows_positions = solver_ && positions_ == positions;
  if (solver_ && revisions == made_for_ && (knows_positions || pin_displacements(body) == pinned_)) {
    if (!knows_positions) {
      held_ = {};
      solver_->reset();
      body.is_at_rest() ? void() : take_positions(body);
      positions_ = positions;
    }
    return;
  }
  std::unique_ptr<ElasticSolver> old = std::move(solver_);
  held_ = {};
  Revisions before_cuts = revisions;
  before_cuts.cuts = made_for_.cuts;
  const bool only_cuts_differ = before_cuts == made_for_ && pin_displacements(body) == pinned_;
  if (old && only_cuts_differ && is_updated(*old, body.cuts(), progress)) {
    solver_ = std::move(old);
    made_for_ = revisions;
    positions_ = positions;
    take_positions(body);
    return;
  }
  old.reset();
  pinned_ = pin_displacements(body);
  solver_ = make_elastic(
      method_, {body.mesh_pointer(), body.cuts(), {body.pins().begin(), body.pins().end()}, pinned_, body.elastic()},
      progress);
  made_for_ = revisions;
  positions_ = positions;
  take_positions(body);
}

void ElasticDeformation::take_positions(const Body& body) {
  solver_->start_from(displacements_of(body.mesh(), body.positions()));
}

/// Throws Error if the body cannot store the answer. Numbers overflow where an object is deformed beyond measure. The
/// next move begins at the positions that the body has.
void ElasticDeformation::check_answer(const Body& body) {
  const std::vector<double>& answer = solver_->displacements();
  const std::vector<double>& rest = body.mesh().rest;
  const double limit = position_limit(body.precision());
  for (std::size_t i = 0; i < answer.size(); ++i) {
    if (!(std::abs(rest[i] + answer[i]) <= limit)) {
      solver_.reset();
      held_ = {};
      throw Error("positions", "the answer of the method is no finite number of the precision",
                  "move the handle less, or reset the object");
    }
  }
}

/// Sets the position of every element, and collects those that moved.
PassCount ElasticDeformation::take_answer(Body& body, std::span<const ElementId> handle,
                                          std::vector<ElementId>& moved) const {
  const std::vector<double>& answer = solver_->displacements();
  moved.clear();
  auto next_held = handle.begin();
  body.with_view([&]<class View>(const View& view) {
    for (ElementId e = 0; e < view.mesh->element_count(); ++e) {
      const auto before = view.positions[e];
      for (int k = 0; k < View::Dimension && !view.pinned(e); ++k) {
        const std::size_t at = std::size_t{e} * View::Dimension + std::size_t(k);
        view.set_position(e, k, view.mesh->rest[at] + answer[at]);
      }
      if (next_held != handle.end() && *next_held == e) {
        ++next_held;
      } else if (view.positions[e] != before) {
        moved.push_back(e);
      }
    }
  });
  return {body.mesh().element_count(), moved.size()};
}

}  // namespace chainmail

#include "solver/solver.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "exact/thread_team.h"
#include "mesh/error.h"

namespace chainmail {

bool stores_displacements(const AlgorithmInfo& algorithm, const Body& body) {
  return algorithm.from_rest || (body.precision() == Precision::single_precision && is_far(body.mesh()));
}

Solver::Solver(MeshPointer mesh, Algorithm algorithm, Precision precision)
    : body_((check(algorithm, *mesh), std::move(mesh)), precision), algorithm_(info(algorithm)) {
  store_for(algorithm_);
}

/// Stores positions as the algorithm needs them. Valid regions lie along their own axes: so does the ChainMail
/// family. All others have no such axes, or have their own.
void Solver::store_for(const AlgorithmInfo& algorithm) {
  body_.work_in_axes(algorithm.family() == Family::chainmail);
  body_.store_displacements(stores_displacements(algorithm, body_));
}

void Solver::set_algorithm(Algorithm algorithm) {
  check(algorithm, body_.mesh());
  store_for(info(algorithm));  // also for the same algorithm: a copied body may store positions the other way
  if (algorithm == algorithm_.algorithm) {
    return;
  }
  algorithm_ = info(algorithm);
  method_.reset();
}

Method& Solver::method() {
  if (!method_) {
    method_ = algorithm_.make(body_.precision(), body_.mesh().space_dimension);
  }
  return *method_;
}

/// Runs a pass. If it fails in the middle, for lack of memory for example, the next pass uses nothing of it.
template <class Pass>
PassCount Solver::run(Pass pass) {
  const RunningPass running;
  try {
    const PassCount count = pass(method());
    body_.note_move();
    return count;
  } catch (const Error&) {
    throw;  // nothing has moved
  } catch (const Cancelled&) {
    throw;
  } catch (...) {
    body_.note_move();
    moved_.clear();
    method_.reset();
    throw;
  }
}

PassCount Solver::move(Handle& handle, const Pose& target, Trace* trace) {
  check_free(body_, handle.elements());
  if (body_.region_axes().is_turned()) {
    return move_along_axes(handle, target, trace);
  }
  HandleMove move{handle, target};
  const PassCount count = run([&](Method& method) {
    return method.move(body_, move, {moved_, trace, threads_, progress_});
  });
  handle.set_pose(move.pose);
  return count;
}

/// The same in the coordinates of the body's axes. A target that is reached, and a pose that is kept, are not rounded.
PassCount Solver::move_along_axes(Handle& handle, const Pose& target, Trace* trace) {
  const RegionAxes& axes = body_.region_axes();
  const Handle turned = handle.in_axes(axes);
  const ElementId first = handle.elements()[0];
  Pose to = into_axes(axes, target);
  if (handle.has_one() && target.pivot == point_of(body_.mesh(), body_.positions(), first)) {
    to.pivot = point_of(*body_.stored_mesh(), body_.stored_positions(), first);
  }
  HandleMove move{turned, to};
  const PassCount count = run([&](Method& method) {
    return method.move(body_, move, {moved_, trace, threads_, progress_});
  });
  handle.set_pose(move.pose == to ? target : move.pose == turned.pose() ? handle.pose() : into_world(axes, move.pose));
  return count;
}

PassCount Solver::move(ElementId element, const Point& target, Trace* trace) {
  if (!single_ || single_->elements()[0] != element) {
    single_.emplace(body_, std::vector<ElementId>{element});
  }
  return move(*single_, {target, Point::Zero()}, trace);
}

void Solver::prepare(ElementId element) {
  if (body_.is_pinned(element)) {
    return;
  }
  const RunningPass running;
  try {
    method().prepare(body_, element, threads_, progress_);
  } catch (const Cancelled&) {
    throw;
  } catch (...) {
    method_.reset();  // the move will say so
  }
}

void Solver::wake(std::span<const ElementId> elements) {
  relaxation_.wake(body_, elements);
  awake_at_ = body_.revisions().positions;
}

void Solver::wake_all() {
  relaxation_.wake_all(body_);
  awake_at_ = body_.revisions().positions;
}

void Solver::sleep() {
  relaxation_.sleep();
  awake_at_.reset();
}

void Solver::forget_relaxation() {
  relaxation_.forget();
  equilibrium_.reset();
  awake_at_.reset();
}

void Solver::set_relaxation(RelaxationScheme scheme) {
  scheme_ = scheme;
  if (info(scheme).sweeps) {
    relaxation_.set_scheme(scheme);
  }
}

RelaxationResult Solver::relax(double step, std::uint64_t budget, std::span<const ElementId> held) {
  const RunningPass running;
  if (info(scheme_).sweeps) {
    return relaxation_.sweep(body_, step, budget, held);
  }
  if (awake_at_ != body_.revisions().positions) {
    return {0, true, 0};  // asleep, or the positions were set since
  }
  return equilibrate([&] { equilibrium_->iterate(body_, held, progress_); });
}

RelaxationResult Solver::solve(double tolerance, int max_iterations, std::span<const ElementId> held,
                               const Progress& progress) {
  const RunningPass running;
  return equilibrate([&] { equilibrium_->solve(body_, held, tolerance, max_iterations, progress); });
}

/// Runs iterations toward the equilibrium. If they fail in the middle, the next ones use nothing of them.
template <class Solve>
RelaxationResult Solver::equilibrate(Solve solve) {
  try {
    if (!equilibrium_) {
      equilibrium_ = EquilibriumSolver::make(body_.mesh().space_dimension);
    }
    equilibrium_->set_threads(threads_);
    solve();
  } catch (const Error&) {
    throw;  // nothing has moved
  } catch (const Cancelled&) {
    throw;
  } catch (...) {
    body_.note_relaxation();
    equilibrium_.reset();
    throw;
  }
  return {body_.mesh().element_count(), true, equilibrium_->largest_step(), equilibrium_->residual(),
          equilibrium_->has_prepared()};
}

std::span<const ElementId> Solver::relaxed() const {
  if (info(scheme_).sweeps) {
    return relaxation_.moved();
  }
  return equilibrium_ ? equilibrium_->moved() : std::span<const ElementId>();
}

std::optional<EquilibriumCertificate> Solver::certificate() {
  return equilibrium_ ? equilibrium_->certificate(body_) : std::nullopt;
}

std::unique_ptr<Solver> make_solver(const MeshPointer& mesh, Algorithm algorithm, Precision precision) {
  return std::make_unique<Solver>(mesh, algorithm, precision);
}

}  // namespace chainmail

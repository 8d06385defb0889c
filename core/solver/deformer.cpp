#include "solver/deformer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "body/snapshot.h"
#include "equilibrium/local_relaxation.h"
#include "exact/thread_team.h"
#include "mesh/error.h"
#include "mesh/parameters.h"

namespace chainmail {
namespace {

/// Relaxes with a scheme until the end of a block.
class SchemeForNow {
 public:
  SchemeForNow(Deformer& deformer, RelaxationScheme scheme, bool local)
      : deformer_(deformer), before_(deformer.relaxation()), was_local_(deformer.relaxes_locally()) {
    deformer_.set_relaxation(scheme, local);
  }
  SchemeForNow(const SchemeForNow&) = delete;
  SchemeForNow& operator=(const SchemeForNow&) = delete;
  ~SchemeForNow() { deformer_.set_relaxation(before_, was_local_); }

 private:
  Deformer& deformer_;
  RelaxationScheme before_;
  bool was_local_;
};

}  // namespace

bool stores_displacements(const AlgorithmInfo& algorithm, const Body& body) {
  return algorithm.from_rest || (body.precision() == Precision::single_precision && is_far(body.mesh()));
}

Deformer::Deformer(MeshPointer mesh, Algorithm algorithm, Precision precision)
    : body_((check(algorithm, *mesh), check(precision, *mesh), std::move(mesh)), precision),
      algorithm_(info(algorithm)) {
  store_for(algorithm_);
}

/// Stores positions as the algorithm needs them. Valid regions lie along their own axes: so does the ChainMail
/// family. All others have no such axes, or have their own.
void Deformer::store_for(const AlgorithmInfo& algorithm) {
  body_.work_in_axes(algorithm.family() == Family::chainmail);
  body_.store_displacements(stores_displacements(algorithm, body_));
}

void Deformer::set_algorithm(Algorithm algorithm) {
  check(algorithm, body_.mesh());
  store_for(info(algorithm));  // also for the same algorithm: a copied body may store positions the other way
  if (algorithm == algorithm_.algorithm) {
    return;
  }
  algorithm_ = info(algorithm);
  method_.reset();
}

Method& Deformer::method() {
  if (!method_) {
    method_ = algorithm_.make(body_.precision(), body_.mesh().space_dimension);
  }
  return *method_;
}

/// Runs a pass. If it fails in the middle, for lack of memory for example, the next pass uses nothing of it.
template <class Pass>
PassCount Deformer::run(Pass pass) {
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

PassCount Deformer::move(Handle& handle, const Pose& target, Trace* trace) {
  check_elements(body_.mesh(), handle.elements());  // it may be of another body
  check_free(body_, handle.elements());
  check(Rotation::of(target.rotation), body_.mesh());
  if (body_.region_axes().is_turned()) {
    return move_along_axes(handle, target, trace);
  }
  HandleMove move{handle, target};
  const PassCount count = run([&](Method& method) {
    return method.move(body_, move, {moved_, trace, threads_, progress_});
  });
  handle.set_pose(move.pose);
  note_handle(handle);
  return count;
}

/// The same in the coordinates of the body's axes. A target that is reached, and a pose that is kept, are not rounded.
PassCount Deformer::move_along_axes(Handle& handle, const Pose& target, Trace* trace) {
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
  note_handle(handle);
  return count;
}

void Deformer::note_handle(const Handle& handle) {
  set_last_handle(handle.elements());
  hold(handle.elements());
  has_changed_ = true;
}

PassCount Deformer::move(ElementId element, const Point& target, Trace* trace) {
  if (!single_ || single_->elements()[0] != element) {
    single_.emplace(body_, std::vector<ElementId>{element});
  }
  return move(*single_, {target, Point::Zero()}, trace);
}

void Deformer::cut(std::span<const LinkId> links) {
  check_links(body_.mesh(), links);
  body_.cut(links);
  has_changed_ = true;
  wake_ends(links);
}

void Deformer::uncut(std::span<const LinkId> links) {
  check_links(body_.mesh(), links);
  body_.uncut(links);
  has_changed_ = true;
  wake_ends(links);
}

void Deformer::wake_ends(std::span<const LinkId> links) {
  for (const LinkId link : links) {
    wake(body_.mesh().links[link]);
  }
}

void Deformer::pin(std::span<const ElementId> elements) {
  check_elements(body_.mesh(), elements);
  body_.pin(elements);
}

void Deformer::unpin(std::span<const ElementId> elements) {
  check_elements(body_.mesh(), elements);
  body_.unpin(elements);
  wake(elements);
}

void Deformer::set_threads(int threads) {
  if (threads < 1) {
    throw Error("threads", "the number is below 1", "use a number from 1");
  }
  threads_ = threads;
}

void Deformer::set_softness(const Softness& softness) {
  check(softness, body_.mesh());
  const std::uint64_t before = body_.revisions().energy;
  body_.set_softness(softness);
  if (body_.revisions().energy != before && !body_.is_at_rest()) {
    wake_all();
  }
}

void Deformer::set_positions(std::span<const double> positions) {
  body_.set_positions(coordinates_of(body_.mesh(), positions, body_.precision()));
  forget_handle();
}

void Deformer::reset() {
  body_.reset();
  forget_handle();
}

void Deformer::restore(const Snapshot& snapshot) {
  check(snapshot, body_.mesh(), body_.precision());
  body_.restore(snapshot);
  forget_handle();
}

void Deformer::restore(const ObjectState& object, const Snapshot& positions, const ElementBlocks& changed) {
  const RegionAxes axes = body_.region_axes();
  body_.restore(object);
  const bool has_turned = body_.region_axes().rotation() != axes.rotation();  // which rounds all positions
  has_turned ? body_.restore(positions) : body_.restore(positions, changed);
  forget_handle();
}

void Deformer::replace(const ObjectState& object, Algorithm algorithm) {
  Deformer other(object.mesh, fits(algorithm, *object.mesh) ? algorithm : Algorithm::natural_queue, body_.precision());
  other.body_.set_elastic(body_.elastic());
  other.body_.restore(object);
  other.set_relaxation(scheme_, is_local_);
  other.progress_ = progress_;
  other.threads_ = threads_;
  *this = std::move(other);
}

Snapshot Deformer::split(const SplitPointer& split, const Snapshot& positions) {
  if (!split || split->before() != body_.mesh_pointer()) {
    throw Error("split", "the object is not the one that was split", "split this object");
  }
  Snapshot after = positions_after(*split, positions, body_.precision());
  const std::vector<ElementId> handle = last_handle_;
  replace(object_after(*split, body_.object()), algorithm());
  body_.restore(after);
  if (std::ranges::none_of(handle, [this](ElementId one) { return body_.is_pinned(one); })) {
    set_last_handle(handle);
  }
  for (ElementId e = split->old_count(); e < body_.mesh().element_count(); ++e) {
    wake(std::span(&e, 1));
    wake(body_.mesh().neighbours_of(e));
  }
  return after;
}

void Deformer::forget_handle() {
  is_incomplete_ = false;  // all positions were set
  release();
  set_last_handle({});
}

void Deformer::prepare(ElementId element) {
  check_elements(body_.mesh(), std::span(&element, 1));
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

bool Deformer::prepare_relaxation() {
  if (!is_local_ || is_incomplete_ || !LocalRelaxation::is_for(body_)) {
    return false;
  }
  const RunningPass running;
  return build_local();
}

void Deformer::wake(std::span<const ElementId> elements) {
  relaxation_.wake(body_, elements);
  awake_at_ = body_.revisions().positions;
}

void Deformer::wake_all() {
  relaxation_.wake_all(body_);
  awake_at_ = body_.revisions().positions;
}

void Deformer::sleep() {
  relaxation_.sleep();
  awake_at_.reset();
}

void Deformer::forget_relaxation() {
  relaxation_.forget();
  equilibrium_.reset();
  forget_local();
  awake_at_.reset();
}

void Deformer::set_relaxation(RelaxationScheme scheme, bool local) {
  scheme_ = scheme;
  is_local_ = local;
  if (info(scheme).sweeps) {
    relaxation_.set_scheme(scheme);
  }
}

RelaxationResult Deformer::relax_slice(double step, std::uint64_t budget, std::span<const ElementId> held) {
  const RunningPass running;
  if (info(scheme_).sweeps) {
    return relaxation_.sweep(body_, step, budget, held);
  }
  if (awake_at_ != body_.revisions().positions) {
    return {0, true, 0};  // asleep, or the positions were set since
  }
  if (may_follow(held)) {
    return follow(held);
  }
  return follows_ ? end_following() : equilibrate(held, [&] { equilibrium_->iterate(body_, held, progress_); });
}

Deformer::Relaxed Deformer::relax(int most, const RelaxOptions& options, const std::function<void()>& after_slice) {
  if (most < 0) {
    throw Error("sweeps", "the number is below 0", "use a number from 0");
  }
  check(parameters::relax_step, options.step);
  check(parameters::relax_until, options.until);
  if (most == 0 || !algorithm_.relaxes()) {
    return {};
  }
  const SchemeForNow scheme(*this, options.scheme, options.local);
  Relaxed done;
  if (!info(options.scheme).sweeps) {
    const RunningPass running;
    const bool follows = may_follow(held_);
    if (follows) {
      const RelaxationResult slice = follow(held_);
      done = {local_iterations_, {}, slice.estimate, slice.nodes};
    }
    if (follows_) {
      end_following();
    }
    if (!follows) {
      const auto solve = [&] { equilibrium_->solve(body_, held_, options.until, most, progress_); };
      done.residual = equilibrate(held_, solve).residual;
      done.sweeps = equilibrium_->iterations();
    }
    if (after_slice) {
      after_slice();
    }
    return done;
  }
  if (!last_handle_.empty()) {
    wake(last_handle_);
    wake(moved_);
  }
  while (done.sweeps < most &&
         sweep(options.step, progress_.part(double(done.sweeps) / most, (done.sweeps + 1.0) / most), after_slice) > 0) {
    ++done.sweeps;
  }
  return done;
}

/// Runs one sweep, in slices between which it can be cancelled. Returns the number of visited elements.
std::uint64_t Deformer::sweep(double step, const Progress& progress, const std::function<void()>& after_slice) {
  std::uint64_t visited = 0;
  while (true) {
    progress.report(std::min(1.0, double(visited) / body_.mesh().element_count()));
    const RelaxationResult slice = relax_slice(step, elements_per_slice, held_);
    visited += slice.visited;
    if (after_slice) {
      after_slice();
    }
    if (slice.sweep_ended) {
      return visited;
    }
  }
}

/// Runs iterations toward the equilibrium. If they fail in the middle, the next ones use nothing of them.
template <class Solve>
void Deformer::try_equilibrate(Solve solve) {
  try {
    solve();
  } catch (const Error&) {
    throw;  // nothing has moved
  } catch (const Cancelled&) {
    throw;
  } catch (...) {
    body_.note_relaxation();
    equilibrium_.reset();
    forget_local();
    throw;
  }
}

bool Deformer::lacks_preparation() const { return is_local_ && !equilibrium_ && LocalRelaxation::is_for(body_); }

/// Runs them for the whole object.
template <class Solve>
RelaxationResult Deformer::equilibrate(std::span<const ElementId> held, Solve solve) {
  const bool is_new = !equilibrium_;
  try_equilibrate([&] {
    if (is_new) {
      equilibrium_ = EquilibriumSolver::make(body_.mesh().space_dimension);
    }
    equilibrium_->set_threads(threads_);
    try {
      solve();
    } catch (const Cancelled&) {
      if (is_new && is_local_) {
        equilibrium_.reset();  // a replay does not know of this
      }
      throw;
    }
  });
  if (local_ && held.empty()) {
    local_->release();
  }
  has_changed_ = was_local_ = false;
  return {body_.mesh().element_count(), true, equilibrium_->largest_step(), equilibrium_->residual(),
          equilibrium_->has_prepared()};
}

bool Deformer::may_follow(std::span<const ElementId> held) const {
  return is_local_ && has_changed_ && !held.empty() && LocalRelaxation::is_for(body_);
}

/// Builds what relaxation that is fine only where needed has for the object and its cuts, unless it is built.
bool Deformer::build_local() {
  if (local_ && local_->fits(body_)) {
    return false;
  }
  complete_relaxation();
  local_ = std::make_shared<LocalRelaxation>(body_, LocalRelaxation::Options{.has_twin = true}, progress_);
  return true;
}

/// Runs iterations that are fine only where needed.
RelaxationResult Deformer::follow(std::span<const ElementId> held) {
  try_equilibrate([&] {
    const bool is_new = build_local();
    const LocalRelaxation::Result result = local_->update(body_, held);
    // The steps are not known: the object has not settled.
    local_slice_ = {body_.mesh().element_count(), true, std::numeric_limits<double>::infinity(), {}, is_new};
    local_slice_.estimate = 2 * result.estimate.value_or(0) + result.distance;
    local_slice_.nodes = result.nodes;
    local_iterations_ = result.iterations;
  });
  has_changed_ = false;
  follows_ = is_incomplete_ = was_local_ = true;
  return local_slice_;
}

/// Completes the last slice that followed the handle.
RelaxationResult Deformer::end_following() {
  complete_relaxation();
  follows_ = local_slice_.has_prepared = false;
  return local_slice_;
}

bool Deformer::complete_relaxation() {
  if (!std::exchange(is_incomplete_, false) || !local_ || !local_->is_of(body_)) {
    return false;
  }
  local_->finish(body_);
  was_local_ = true;
  return true;
}

void Deformer::forget_local() {
  local_.reset();
  has_changed_ = follows_ = is_incomplete_ = was_local_ = false;
}

std::span<const ElementId> Deformer::relaxed() const {
  if (info(scheme_).sweeps) {
    return relaxation_.moved();
  }
  if (was_local_) {
    return local_->moved();
  }
  return equilibrium_ ? equilibrium_->moved() : std::span<const ElementId>();
}

std::optional<EquilibriumCertificate> Deformer::certificate() {
  return equilibrium_ ? equilibrium_->certificate(body_) : std::nullopt;
}

}  // namespace chainmail

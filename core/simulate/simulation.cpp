#include "simulate/simulation.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <string>
#include <utility>

#include "measure/shape_measures.h"
#include "mesh/error.h"
#include "mesh/parameters.h"

namespace chainmail {
namespace {

using Clock = PassTimes::Clock;

// Relaxation has settled when no step of a sweep exceeds this share of the mean rest length.
constexpr double asleep_below = 1e-4;
// The scheme `equilibrium` also needs a residual of at most this.
constexpr double settled_below = 1e-4;
// Relaxation gives up if its residual, or the largest step of its sweeps, has not fallen below this share of the least
// so far in so many iterations or sweeps. Counts, unlike a time, are the same in a replay.
constexpr double falls_below = 0.99;
constexpr std::uint64_t most_iterations = 500, most_sweeps = 2000;
constexpr LinkId links_per_slice = 50'000;

}  // namespace

Simulation::Simulation(MeshPointer mesh, Algorithm algorithm, Precision precision)
    : deformer_(std::move(mesh), algorithm, precision),
      changed_(this->mesh().element_count()),
      unmeasured_(changed_),
      away_(changed_),
      unkept_(changed_) {
  changed_.insert_all();
  statistics_.algorithm = algorithm;
}

void Simulation::set_progress(const Progress& progress) {
  progress_ = progress;
  deformer_.set_progress(progress);
}

void Simulation::prepare(ElementId element) {
  if (!grabbed_ && element < mesh().element_count()) {
    deformer_.prepare(element);
  }
}

bool Simulation::prepare_relaxation() {
  return relaxation_on_ && info(algorithm()).relaxes() && deformer_.prepare_relaxation();
}

void Simulation::apply(const Command& command) {
  if (!is_one_of<commands::Drag, commands::Relaxed>(command)) {
    complete_relaxation();
  }
  std::visit([this](const auto& one) { carry_out(one); }, command);
}

/// Writes what is not seen during a drag, so that states that are kept are complete.
void Simulation::complete_relaxation() {
  if (deformer_.complete_relaxation()) {
    mark(deformer_.relaxed());
  }
}

void Simulation::pass(const std::shared_ptr<Handle>& handle, const Pose& target) {
  const bool was_valid = valid_;
  time_pass([&] { return deformer_.move(*handle, target, trace_); });
  last_handle_ = handle;
  if (!grabbed_) {
    deformer_.release();  // a pass that follows an edit
  }
  // Links inside a handle of many stay as they are. A rotation may violate them.
  valid_ =
      info(algorithm()).holds_links && (handle->has_one() || (was_valid && handle->pose().rotation == Point::Zero()));
  for (const auto& moved : {handle->elements(), deformer_.moved()}) {
    mark(moved);
    wake(moved);
  }
}

template <class Move>
void Simulation::time_pass(Move move) {
  const auto start = Clock::now();
  try {
    statistics_.last_pass = move();
  } catch (const Error&) {
    throw;  // nothing has moved
  } catch (const Cancelled&) {
    throw;
  } catch (...) {
    mark_all();  // the pass may have stopped in the middle
    valid_ = false;
    statistics_.remark = failure_sentence("stopped");
    throw;
  }
  const auto end = Clock::now();
  statistics_.last_pass_ms = std::chrono::duration<double, std::milli>(end - start).count();
  times_.add(end, statistics_.last_pass_ms);
  ++statistics_.passes;
  statistics_.remark = deformer_.remark();
  relaxation_fails_ = false;
}

void Simulation::note_change(const ElementBlocks& blocks) {
  changed_.insert(blocks);
  unmeasured_.insert(blocks);
}

void Simulation::mark(std::span<const ElementId> moved) {
  changed_.insert(moved);
  unmeasured_.insert(moved);
  away_.insert(moved);
  unkept_.insert(moved);
}

void Simulation::mark_all() {
  changed_.insert_all();
  unmeasured_.insert_all();
  away_.insert_all();
  unkept_.insert_all();
}

bool Simulation::continue_relaxation() {
  if (!relaxes_in_idle_time()) {
    return false;
  }
  const auto start = Clock::now();
  try {
    try_slice();
  } catch (const Cancelled&) {
    // A command waits.
  }
  statistics_.relaxation_ms += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return statistics_.relaxing;
}

/// Runs a slice of relaxation, or ends relaxation if that fails.
void Simulation::try_slice() {
  try {
    if (run_slice()) {
      fall_asleep();
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    refuse_relaxation(error.what());
  } catch (...) {
    refuse_relaxation(failure_sentence("relaxation"));
  }
  ++slices_;
}

/// Runs a slice of relaxation. Returns true if the object has settled, or comes no closer to that.
bool Simulation::run_slice() {
  const RelaxationResult slice = relax_slice(relaxation_step_);
  prepared_ = slice.has_prepared;
  if (!slice.sweep_ended) {
    return false;
  }
  ++statistics_.sweeps;
  // Elements that became active during the sweep have not been visited yet.
  if (std::exchange(woken_, false)) {
    return false;
  }
  const double length = mesh().mean_link_length;
  const double distance = slice.residual.value_or(length > 0 ? slice.largest_step / length : slice.largest_step);
  const bool has_settled =
      slice.largest_step <= asleep_below * length && (!slice.residual || *slice.residual <= settled_below);
  if (!has_settled && comes_closer(distance)) {
    return false;
  }
  const auto turned = softness().energy == EnergyKind::material ? inverted_cells(mesh(), body().positions()) : 0;
  if ((!has_settled || turned.value_or(0) > 0) && !std::exchange(has_begun_again_, true)) {
    closest_sweep_ = 0;  // another start may find a way out
    deformer_.forget_relaxation();
    deformer_.wake_all();
    return false;
  }
  if (!has_settled) {
    statistics_.unsettled = distance;
  }
  if (turned.value_or(0) > 0) {
    statistics_.remark = "relaxation stays in a local minimum, cells inside out: " + std::to_string(*turned);
    relaxation_fails_ = true;
  }
  return true;
}

bool Simulation::comes_closer(double distance) {
  if (closest_sweep_ == 0 || distance < falls_below * closest_) {
    closest_ = distance;
    closest_sweep_ = statistics_.sweeps;
  }
  return statistics_.sweeps - closest_sweep_ < (info(deformer_.relaxation()).sweeps ? most_sweeps : most_iterations);
}

/// Begins relaxation as if it had done nothing before, with all elements or with none.
void Simulation::begin_relaxation(bool awake) {
  fall_asleep();
  deformer_.forget_relaxation();
  if (awake && info(algorithm()).relaxes()) {
    deformer_.wake_all();
    wake({});
  }
}

RelaxationResult Simulation::relax_slice(double step) {
  return take_relaxed([&] {
    if (away_.empty() && !info(deformer_.relaxation()).sweeps) {  // at rest: nothing need be prepared to know that
      return RelaxationResult{.visited = 0, .sweep_ended = true, .largest_step = 0, .residual = 0.0};
    }
    const RelaxationResult slice = deformer_.relax_slice(step, Deformer::elements_per_slice, grabbed());
    mark(deformer_.relaxed());
    return slice;
  });
}

/// Takes over the result of some relaxation.
template <class Relax>
RelaxationResult Simulation::take_relaxed(Relax relax) {
  try {
    const RelaxationResult slice = relax();
    statistics_.residual = slice.residual;  // sweeps have none
    statistics_.estimate = slice.estimate;
    statistics_.nodes = slice.nodes;
    if (slice.residual && std::exchange(relaxation_fails_, false)) {
      statistics_.remark.clear();
    }
    return slice;
  } catch (const Error&) {
    throw;  // nothing has moved
  } catch (const Cancelled&) {
    throw;
  } catch (...) {
    mark_all();  // an iteration may have stopped in the middle
    throw;
  }
}

void Simulation::refuse_relaxation(const std::string& reason) {
  statistics_.remark = reason;
  statistics_.residual.reset();
  statistics_.estimate.reset();
  relaxation_fails_ = true;
  fall_asleep();
}

void Simulation::relax(int count, const RelaxOptions& options) {
  if (count == 0 || !info(algorithm()).relaxes()) {
    deformer_.relax(count, options);  // checks the options; what is known of the last relaxation stays
    return;
  }
  take_relaxed([&] {
    RelaxationResult result;
    const auto done = deformer_.relax(count, options, [this] { mark(deformer_.relaxed()); });
    result.residual = done.residual;
    result.estimate = done.estimate;
    result.nodes = done.nodes;
    return result;
  });
}

bool Simulation::measure() {
  if (!unmeasured_.empty()) {
    meter_.forget(mesh(), unmeasured_);
    unmeasured_.clear();
  }
  statistics_.violation = meter_.measure(mesh(), softness(), body().cuts(), body().positions(), links_per_slice);
  statistics_.last_second = times_.summary(Clock::now());
  if (statistics_.violation.is_whole) {
    valid_ = statistics_.violation.fraction == 0;
  }
  return statistics_.violation.is_whole;
}

void Simulation::measure_all() {
  while (!measure()) {
  }
}

/// Call this after the deformer got another object.
void Simulation::follow_mesh() {
  statistics_.algorithm = algorithm();
  away_ = changed_ = unkept_ = unmeasured_ = ElementBlocks(mesh().element_count());
  meter_ = {};
  statistics_.violation = {};
  last_kept_ = {};
  changed_.insert_all();
  grabbed_.reset();
  last_handle_.reset();
  valid_ = true;
  forget_passes();
  statistics_.relaxing = false;
}

/// Call this after positions were set: no handle was moved since.
void Simulation::let_go() {
  grabbed_.reset();
  set_last_handle(nullptr);
  deformer_.release();
}

void Simulation::set_last_handle(std::shared_ptr<Handle> handle) {
  last_handle_ = std::move(handle);
  deformer_.set_last_handle(elements_of(last_handle_));
}

/// Clears the statistics of passes of another object or algorithm.
void Simulation::forget_passes() {
  statistics_.last_pass = {};
  statistics_.last_pass_ms = 0;
  statistics_.last_second = {};
  statistics_.remark.clear();
  statistics_.residual.reset();
  statistics_.estimate.reset();
  statistics_.unsettled.reset();
  relaxation_fails_ = false;
  times_.clear();
}

void Simulation::wake(std::span<const ElementId> elements) {
  if (relaxation_on_ && info(algorithm()).relaxes()) {
    deformer_.wake(elements);
    woken_ = true;
    statistics_.relaxing = true;
    has_begun_again_ = false;
    statistics_.unsettled.reset();
    statistics_.sweeps = closest_sweep_ = 0;
  }
}

void Simulation::fall_asleep() {
  deformer_.sleep();
  statistics_.relaxing = false;
}

// How each command is carried out.

void Simulation::carry_out(const commands::Grab& command) {
  grabbed_ = std::make_shared<Handle>(body(), command.elements);
  deformer_.hold(grabbed());
}

void Simulation::carry_out(const commands::Drag& command) {
  if (!grabbed_) {
    throw Error("drag", "no element is grabbed", "grab one first");
  }
  check(command.rotation, mesh());
  const Point from = command.relative ? grabbed_->grabbed().pivot : Point(Point::Zero());
  pass(grabbed_, {command.relative ? Point(from + command.target) : command.target, command.rotation.vector()});
}

void Simulation::carry_out(const commands::Release&) {
  if (grabbed_) {
    // The released elements may follow their neighbours, in idle time or in requested sweeps.
    deformer_.wake(grabbed());
    wake({});
  }
  grabbed_.reset();
  deformer_.release();
  if (std::exchange(statistics_.last_pass.stopped, false)) {
    statistics_.remark.clear();  // the handle no longer pulls
  }
}

void Simulation::carry_out(const commands::SetSoftness& command) {
  check(*command.softness, mesh());
  const Revisions before = body().revisions();
  set_softness(command.softness);
  const bool new_energy = body().revisions().energy != before.energy;
  if (!new_energy || body().revisions().softness != before.softness) {
    valid_ = false;
    if (info(algorithm()).uses_softness()) {
      answer();
    }
  }
  if (new_energy && last_handle_) {  // otherwise all elements are at rest, where every energy is least
    deformer_.wake_all();
    wake({});
  }
  if (!info(deformer_.relaxation()).sweeps && last_handle_) {
    wake({});  // the equilibrium depends on the softness, even if no pass can answer
  }
}

/// Equal softness leaves all regions unchanged.
void Simulation::set_softness(const std::shared_ptr<const Softness>& softness) {
  if (softness != body().shared_softness() && *softness != this->softness()) {
    const RegionAxes before = body().region_axes();
    deformer_.body().set_softness(softness);
    meter_.forget_all();
    note_axes(before);
  }
}

/// Another frame rounds all positions, also those at rest.
void Simulation::note_axes(const RegionAxes& before) {
  if (body().region_axes().rotation() != before.rotation()) {
    note_rounding();
  }
}

/// All positions are rounded anew. What is at rest stays so for snapshots.
void Simulation::note_rounding() {
  changed_.insert_all();
  unmeasured_.insert_all();
  if (!away_.empty()) {
    mark_all();
  }
}

/// Runs a pass after a change that may have violated links while the object is deformed. The pass starts at the handle,
/// or at the one that was moved last. It moves nothing if all links are valid.
void Simulation::answer() {
  if (!last_handle_) {
    return;  // no element has moved since rest
  }
  const auto about = grabbed_ ? grabbed_ : last_handle_;
  if (std::ranges::any_of(about->elements(), [this](ElementId one) { return body().is_pinned(one); })) {
    return;
  }
  try {
    if (about->has_one()) {
      pass(about, {point_of(mesh(), body().positions(), about->elements()[0]), Point::Zero()});
    } else if (grabbed_) {
      pass(grabbed_, grabbed_->pose());
    } else {  // its elements may have moved apart since it was released
      const auto again =
          std::make_shared<Handle>(body(), std::vector<ElementId>(about->elements().begin(), about->elements().end()));
      pass(again, again->grabbed());
    }
  } catch (const Error&) {
    // The pins now contradict each other. The setting stays, and the next drag reports the error.
  }
}

void Simulation::carry_out(const commands::SetElastic& command) {
  check(command.options);
  if (command.options != elastic()) {
    deformer_.body().set_elastic(command.options);
    if (info(algorithm()).family() == Family::elastic) {
      answer();
    }
    if (softness().energy == EnergyKind::material && !info(deformer_.relaxation()).sweeps && last_handle_) {
      wake({});  // the equilibrium depends on the material
    }
  }
}

void Simulation::carry_out(const commands::Relax& command) {
  relax(static_cast<int>(command.sweeps), {command.step, command.scheme, command.until, command.local});
}

void Simulation::carry_out(const commands::Relaxed& command) {
  check(parameters::relax_step, command.step);
  relaxation_on_ = repeats_slices_ = true;
  relaxation_step_ = command.step;
  deformer_.set_relaxation(command.scheme, command.local);
  if (command.start != commands::Relaxed::Start::goes_on) {
    begin_relaxation(command.start == commands::Relaxed::Start::awake);
  }
  const std::uint32_t count = command.counts->slices_for(command.panel, algorithm());
  for (std::uint32_t i = 0; i < count && statistics_.relaxing; ++i) {
    progress_.report(double(i) / double(count));  // a slice is long
    try_slice();
  }
}

void Simulation::carry_out(const commands::SetRelaxation& command) {
  check(parameters::relax_step, command.step);
  relaxation_ = {command.on, command.step, command.scheme, false, command.local};
  repeats_slices_ = false;
  const bool was_on = std::exchange(relaxation_on_, command.on);
  const bool is_other = deformer_.relaxation() != command.scheme || deformer_.relaxes_locally() != command.local;
  relaxation_step_ = command.step;
  deformer_.set_relaxation(command.scheme, command.local);
  if (is_other) {
    statistics_.residual.reset();
    statistics_.estimate.reset();
  }
  if (!command.on) {
    statistics_.unsettled.reset();
    fall_asleep();
  } else if (!was_on || is_other || command.anew) {
    begin_relaxation(true);
  }
}

void Simulation::carry_out(const commands::SetAlgorithm& command) {
  const RegionAxes axes = body().region_axes();
  const bool stored_displacements = body().stores_displacements();
  const Algorithm before = algorithm();
  deformer_.set_algorithm(command.algorithm);
  note_axes(axes);
  if (before == command.algorithm) {
    return;
  }
  if (stored_displacements != body().stores_displacements() && (!away_.empty() || body().region_axes().is_turned())) {
    note_rounding();  // by converting between displacements and positions
  }
  statistics_.algorithm = command.algorithm;
  forget_passes();
  if (!info(algorithm()).relaxes()) {
    fall_asleep();
  }
  if (info(algorithm()).answers_any_state()) {
    answer();
  }
}

void Simulation::carry_out(const commands::Cut& command) {
  deformer_.cut(command.links);
  meter_.forget(command.links);
  wake({});
}

void Simulation::carry_out(const commands::Uncut& command) {
  deformer_.uncut(command.links);
  meter_.forget(command.links);
  valid_ = false;  // the ends may have moved too far apart while the link was cut
  wake({});
}

void Simulation::carry_out(const commands::Pin& command) {
  for (const ElementId element : command.elements) {
    if (grabbed_ && grabbed_->contains(element)) {
      throw Error("element " + std::to_string(element), "it is grabbed", "release it, then pin it");
    }
  }
  deformer_.pin(command.elements);
}

void Simulation::carry_out(const commands::Unpin& command) {
  deformer_.unpin(command.elements);
  wake({});
}

void Simulation::carry_out(const commands::Reset&) {
  deformer_.body().reset(away_);
  note_change(away_);
  unkept_.insert(away_);
  away_.clear();
  set_last_handle(nullptr);
  if (grabbed_) {  // at rest now
    grabbed_ = std::make_shared<Handle>(body(), std::vector<ElementId>(grabbed().begin(), grabbed().end()));
  }
  forget_passes();
  valid_ = true;
  begin_relaxation(false);
}

void Simulation::carry_out(const commands::ReplaceMesh& command) {
  if (!command.mesh) {
    throw Error("replace mesh", "the command contains no mesh", "use a command with a mesh");
  }
  const auto kept = std::make_shared<const Softness>(kept_for(*command.mesh, softness()));
  deformer_.replace({command.mesh, {}, {}, kept}, algorithm());
  follow_mesh();
}

void Simulation::carry_out(const commands::Split& command) {
  const bool was_valid = valid_ && away_.empty();  // links inside faces and cells are new
  const bool was_relaxing = statistics_.relaxing;
  Snapshot positions = deformer_.split(command.split, current_positions());
  follow_mesh();
  note_kept(std::move(positions));
  valid_ = was_valid;
  if (const auto last = deformer_.last_handle(); !last.empty()) {
    last_handle_ = std::make_shared<Handle>(body(), std::vector<ElementId>(last.begin(), last.end()));
  }
  if (was_relaxing) {
    deformer_.wake_all();
  }
  wake({});
}

// Saved states, for undo and for replay of recorded commands.

/// Without enough memory, the state gets the positions that were kept before it: cuts, pins and softness can still be
/// restored.
void Simulation::carry_out(const commands::KeepState& command) {
  try {
    kept_.insert_or_assign(command.state, UndoState(current_state()));
  } catch (const std::bad_alloc&) {
    kept_.insert_or_assign(command.state, UndoState({body().object(), last_kept_, valid_}));
    throw Error("undo", "there is not enough memory to keep these positions",
                "save your work; undoing the next step returns to earlier positions");
  }
}

void Simulation::carry_out(const commands::RestoreState& command) {
  const auto found = kept_.find(command.state);
  if (found == kept_.end()) {
    throw Error("state " + std::to_string(command.state), "this saved state does not exist", "save it first");
  }
  restore(found->second.state());
}

void Simulation::carry_out(const commands::DropState& command) { kept_.erase(command.state); }

void Simulation::carry_out(const commands::SetPositions& command) {
  check(*command.snapshot, mesh(), body().precision());
  restore({body().object(), *command.snapshot, command.snapshot->is_at_rest()});
}

SimulationState Simulation::hand_over() {
  complete_relaxation();
  const auto copy = [](const std::shared_ptr<Handle>& handle) {
    return handle ? std::make_shared<const Handle>(*handle) : nullptr;
  };
  return {current_state(), kept_, relaxation(), elastic(), copy(grabbed_), copy(last_handle_)};
}

void Simulation::take(const SimulationState& state, Algorithm algorithm) {
  deformer_.replace(state.object, algorithm);
  deformer_.body().set_elastic(state.elastic);
  follow_mesh();
  restore(state.object);
  kept_ = state.kept;
  carry_out(state.relaxation);
  grabbed_ = state.grabbed ? std::make_shared<Handle>(*state.grabbed) : nullptr;
  deformer_.hold(grabbed());
  set_last_handle(state.last_handle ? std::make_shared<Handle>(*state.last_handle) : nullptr);
}

KeptState Simulation::current_state() { return {body().object(), current_positions(), valid_}; }

/// Returns the positions. They share the blocks that did not change since they were last saved or restored.
const Snapshot& Simulation::current_positions() {
  Snapshot positions = last_kept_;
  body().update(positions, unkept_, away_);  // may run out of memory, so it comes before any change
  last_kept_ = std::move(positions);
  unkept_.clear();
  return last_kept_;
}

/// Call this when the positions have become those of a snapshot.
void Simulation::note_kept(Snapshot positions) {
  away_ = positions.away(mesh());
  last_kept_ = std::move(positions);
  unkept_.clear();
  if (last_kept_.from_rest != body().stores_displacements() ||
      last_kept_.axes.rotation() != body().region_axes().rotation()) {
    unkept_ = away_;  // the positions have been converted and rounded
  }
}

/// Copies only blocks that the two states do not share, or in which a position has changed since they were saved.
void Simulation::restore(const KeptState& state) {
  if (state.mesh != mesh_pointer()) {
    deformer_.replace(state, algorithm());
    follow_mesh();
  }
  set_softness(state.softness);
  std::vector<LinkId> differing;
  std::ranges::set_symmetric_difference(body().cuts().links(), state.cuts, std::back_inserter(differing));
  meter_.forget(differing);
  Snapshot positions = state.positions;
  positions.blocks.resize(away_.block_count());
  last_kept_.blocks.resize(away_.block_count());
  for (std::size_t block = 0; block < away_.block_count(); ++block) {
    if (positions.blocks[block] != last_kept_.blocks[block]) {
      unkept_.insert_block(block);
    }
  }
  deformer_.restore(state, positions, unkept_);
  note_change(unkept_);
  note_kept(std::move(positions));
  valid_ = state.valid;
  forget_passes();
  let_go();
  begin_relaxation(false);
}

}  // namespace chainmail

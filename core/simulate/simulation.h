#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/pass_times.h"
#include "measure/violation.h"
#include "mesh/progress.h"
#include "simulate/command.h"
#include "simulate/simulation_state.h"
#include "solver/deformer.h"

namespace chainmail {

/// Statistics of a simulation, for display.
struct Statistics {
  Algorithm algorithm = Algorithm::natural_queue;
  std::uint64_t passes = 0;  // since the start
  PassCount last_pass;
  double last_pass_ms = 0;
  PassTimes::Summary last_second;
  MeasuredViolation violation;
  bool relaxing = false;
  double relaxation_ms = 0;  // of slices of relaxation since the last frame
  /// Set if relaxation has stopped because it came no closer: the residual, or the largest step of a sweep in mean rest
  /// lengths.
  std::optional<double> unsettled;
  std::uint64_t sweeps = 0;  // since the last pass; iterations with the scheme `equilibrium`
  /// After an iteration toward the equilibrium: the estimated distance from it, see EquilibriumCertificate.
  std::optional<double> residual;
  /// After a slice that was fine only where needed: see RelaxationResult.
  std::optional<double> estimate;
  std::size_t nodes = 0;
  /// Reason why the last pass did not reach its target or did not converge, or why relaxation ended; usually empty.
  std::string remark;
};

/// Simulates one object: receives commands, and provides positions and statistics. One thread uses it. Read apply() in
/// simulation.cpp first.
class Simulation {
 public:
  Simulation(MeshPointer mesh, Algorithm algorithm, Precision precision);

  /// Carries out a command. Throws Error if the command does not fit the object (an element or link that does not
  /// exist, softness out of range, a drag without a grab, a saved state that does not exist); then nothing changes.
  void apply(const Command& command);
  /// Runs a slice of relaxation of about 2 ms, or one iteration toward the equilibrium, for idle time. Returns true if
  /// there is more to do. If there is no equilibrium, or if it fails, relaxation ends and the remark says why.
  bool continue_relaxation();
  /// True if there is something to relax in idle time.
  bool relaxes_in_idle_time() const { return statistics_.relaxing && !repeats_slices_; }
  /// Returns the number of slices so far that were not cancelled.
  std::uint32_t slices() const { return slices_; }
  /// True if the next slice follows the handle: see Deformer::follows_next.
  bool follows_next() const { return deformer_.follows_next(grabbed()); }
  /// True if a command should cancel the next slice: see Deformer::lacks_preparation.
  bool gives_way() const { return !follows_next() && deformer_.lacks_preparation(); }
  /// True if the last slice prepared later ones, which are much faster.
  bool has_prepared() const { return prepared_; }

  /// Returns everything except the algorithm and the statistics. Shares data with the saved states.
  SimulationState hand_over();
  /// Continues from a state with `algorithm`, or with Natural Queue if the algorithm does not support the mesh.
  /// Nothing moves, but positions may be rounded as with SetAlgorithm.
  void take(const SimulationState& state, Algorithm algorithm);

  /// Sets the progress of long work, which throws Cancelled when it is cancelled. A cancelled pass of a method of
  /// elasticity moves nothing. Sweeps of relaxation end within some milliseconds and keep the positions reached.
  void set_progress(const Progress& progress);
  /// Sets the number of threads that a pass may use: see Deformer::set_threads.
  void set_threads(int threads) { deformer_.set_threads(threads); }
  /// Prepares a drag of an element, in idle time: see Deformer::prepare. Nothing happens while something is grabbed.
  void prepare(ElementId element);
  /// Prepares relaxation in idle time that is fine only where needed: see Deformer::prepare_relaxation.
  bool prepare_relaxation();
  /// Sets the trace that receives every candidate that a pass processes; null: none.
  void set_trace(Trace* trace) { trace_ = trace; }
  /// Runs sweeps or iterations of relaxation at once, even if relaxation is off: see Deformer::relax.
  void relax(int count, const RelaxOptions& options);
  /// Returns how close the object is to the equilibrium; none if the scheme `equilibrium` has not relaxed it.
  std::optional<EquilibriumCertificate> certificate() { return deformer_.certificate(); }

  const Mesh& mesh() const { return body().mesh(); }
  const MeshPointer& mesh_pointer() const { return body().mesh_pointer(); }
  const Deformer& deformer() const { return deformer_; }
  const Body& body() const { return deformer_.body(); }
  const Softness& softness() const { return body().softness(); }
  const ElasticOptions& elastic() const { return body().elastic(); }
  /// Returns the relaxation that was set last.
  const commands::SetRelaxation& relaxation() const { return relaxation_; }
  /// The elements of the handle, ascending; empty while nothing is grabbed.
  std::span<const ElementId> grabbed() const { return elements_of(grabbed_); }
  /// Returns the handle of the last pass; null before the first one.
  const Handle* last_handle() const { return last_handle_.get(); }
  /// Returns a snapshot of the positions, for SetPositions.
  Snapshot snapshot() const { return body().snapshot(away_); }
  /// Returns the blocks in which a position may have changed since forget_changes().
  const ElementBlocks& changed() const { return changed_; }
  void forget_changes() { changed_.clear(); }
  /// Begins a frame: the time of relaxation is counted from here.
  void begin_frame() { statistics_.relaxation_ms = 0; }
  const Statistics& statistics() const { return statistics_; }
  /// Returns true if it is known, without a check of the whole mesh, that no link is violated beyond rounding.
  bool valid() const { return valid_; }

  /// Updates the statistics that are too expensive for each pass: the times of the last second, and the violation. It
  /// measures the links that changed since it was measured, but only some milliseconds long: if there are too many,
  /// some stay for the next call. Returns true if all are measured.
  bool measure();
  /// Updates them, however long it takes.
  void measure_all();
  /// Returns true if the violation in the statistics is that of the present positions of all links.
  bool is_measured() const { return statistics_.violation.is_whole && meter_.is_complete() && unmeasured_.empty(); }

 private:
  void carry_out(const commands::Grab& command);
  void carry_out(const commands::Drag& command);
  void carry_out(const commands::Release& command);
  void carry_out(const commands::SetSoftness& command);
  void carry_out(const commands::SetRelaxation& command);
  void carry_out(const commands::Relax& command);
  void carry_out(const commands::Relaxed& command);
  void carry_out(const commands::SetAlgorithm& command);
  void carry_out(const commands::Cut& command);
  void carry_out(const commands::Uncut& command);
  void carry_out(const commands::Pin& command);
  void carry_out(const commands::Unpin& command);
  void carry_out(const commands::Reset& command);
  void carry_out(const commands::ReplaceMesh& command);
  void carry_out(const commands::Split& command);
  void carry_out(const commands::SetPositions& command);
  void carry_out(const commands::SetElastic& command);
  void carry_out(const commands::KeepState& command);
  void carry_out(const commands::RestoreState& command);
  void carry_out(const commands::DropState& command);

  void complete_relaxation();
  bool run_slice();
  void try_slice();
  bool comes_closer(double distance);
  void begin_relaxation(bool awake);
  RelaxationResult relax_slice(double step);
  template <class Relax>
  RelaxationResult take_relaxed(Relax relax);
  void refuse_relaxation(const std::string& reason);
  void answer();
  void forget_passes();
  void set_softness(const std::shared_ptr<const Softness>& softness);
  void note_axes(const RegionAxes& before);
  void note_rounding();
  static std::span<const ElementId> elements_of(const std::shared_ptr<Handle>& handle) {
    return handle ? handle->elements() : std::span<const ElementId>();
  }
  void pass(const std::shared_ptr<Handle>& handle, const Pose& target);
  void let_go();
  void set_last_handle(std::shared_ptr<Handle> handle);
  template <class Move>
  void time_pass(Move move);
  void note_change(const ElementBlocks& blocks);
  void mark(std::span<const ElementId> moved);
  void mark_all();
  Algorithm algorithm() const { return deformer_.algorithm(); }
  void follow_mesh();
  void wake(std::span<const ElementId> elements);
  void fall_asleep();
  KeptState current_state();
  const Snapshot& current_positions();
  void note_kept(Snapshot positions);
  void restore(const KeptState& state);

  Deformer deformer_;
  ElementBlocks changed_;                // changed blocks since forget_changes()
  ElementBlocks unmeasured_;             // changed blocks since the violation was measured
  ElementBlocks away_;                   // all elements outside these blocks are at rest
  Snapshot last_kept_;                   // positions that were last saved or restored
  ElementBlocks unkept_;                 // blocks in which a position may have changed since then
  std::shared_ptr<Handle> grabbed_;      // null: nothing is grabbed
  std::shared_ptr<Handle> last_handle_;  // of the last pass, if any
  bool valid_ = true;
  commands::SetRelaxation relaxation_;  // as it was set
  // What runs: a repetition may have other values.
  bool relaxation_on_ = false;
  double relaxation_step_ = 1;
  bool woken_ = false;             // true if elements became active since the last sweep ended
  bool prepared_ = false;          // true if the last slice prepared later ones
  bool relaxation_fails_ = false;  // true if the remark is about relaxation
  bool repeats_slices_ = false;    // relaxation runs only as often as commands say: see commands::Relaxed
  std::uint32_t slices_ = 0;
  double closest_ = 0;               // residual, or largest step in mean rest lengths, that relaxation has reached
  std::uint64_t closest_sweep_ = 0;  // when: see Statistics::sweeps. 0: not yet
  bool has_begun_again_ = false;     // because it came no closer
  std::map<commands::StateId, UndoState> kept_;
  PassTimes times_;
  ViolationMeter meter_;
  Statistics statistics_;
  Trace* trace_ = nullptr;
  Progress progress_;
};

}  // namespace chainmail

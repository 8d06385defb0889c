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
#include "simulate/handover.h"
#include "solve/solver.h"

namespace chainmail {

/// What a reader of a frame wants to know of the simulation.
struct Statistics {
  Algorithm algorithm = Algorithm::natural_queue;
  std::uint64_t passes = 0;  // since the start
  PassCount last_pass;
  double last_pass_ms = 0;
  PassTimes::Summary last_second;
  Violation violation;
  bool violation_of_whole_mesh = false;  // else of the links that the last pass touched
  bool relaxing = false;
  std::uint64_t sweeps = 0;  // since the last pass
  /// Why the last pass did not end where it should have; empty mostly.
  std::string remark;
};

/// An object in time: commands in, positions and statistics out. It knows no thread.
class Simulation {
 public:
  Simulation(MeshPointer mesh, Algorithm algorithm, Precision precision);

  /// Carries a command out. Throws Error where the command does not fit the object (an element or link
  /// that is not there, softness out of range, a drag without a grab, a state that is not kept);
  /// nothing has changed then.
  void apply(const Command& command);
  /// Spends idle time: a slice of relaxation of about 2 ms. Returns whether there is more to do.
  bool step();

  /// All there is but the algorithm and the figures. Shares with what is kept.
  Handover hand_over();
  /// Goes on from there by an algorithm, or by Natural Queue where it does not work on the mesh. Nothing moves; where
  /// one of Exact and another take over from each other, positions are rounded as SetAlgorithm rounds them.
  void take(const Handover& handover, Algorithm algorithm);

  /// Where work that takes long reports and learns that it is no longer wanted: it leaves by Cancelled. A pass by a
  /// method of elasticity has moved nothing then; sweeps of relaxation end within some milliseconds, and what they have
  /// moved stays where it is.
  void set_progress(const Progress& progress);
  /// `trace`, where set, receives every candidate that a pass processes.
  void set_trace(Trace* trace) { trace_ = trace; }
  /// Sweeps of relaxation at once, by the scheme last set, whether it is on or off: `count` of them, or until
  /// nothing moves.
  void relax(int count, double step);

  const Mesh& mesh() const { return *mesh_; }
  const MeshPointer& mesh_pointer() const { return mesh_; }
  const Solver& solver() const { return *solver_; }
  const Softness& softness() const { return *softness_; }
  const ElasticOptions& elastic() const { return elastic_; }
  commands::SetRelaxation relaxation() const { return {relaxation_on_, relaxation_step_, relaxation_scheme_}; }
  std::optional<ElementId> grabbed() const { return grabbed_; }
  /// Those of free-form deformation, which is prepared for them; none by other algorithms, or where it has no answer.
  std::span<const double> control_points();
  /// The element that the last pass was about.
  std::optional<ElementId> last_moved() const { return last_moved_; }
  /// Where the elements stand, to be placed there again.
  Snapshot placement() const { return solver_->placement(away_); }
  /// The blocks in which a position may have changed since forget_changes().
  const ElementBlocks& changed() const { return changed_; }
  void forget_changes() { changed_.clear(); }
  const Statistics& statistics() const { return statistics_; }
  /// No link violated beyond rounding, as far as is known without looking at the whole mesh.
  bool valid() const { return valid_; }

  /// Refreshes the figures that cost more than a pass may: the times of the last second and the violation,
  /// over the whole mesh or over the links that the last pass touched.
  void refresh_statistics(bool whole_mesh);
  /// Spends idle time on the same over the whole mesh: a slice of some milliseconds. What was measured before a
  /// command or a step is dropped. Returns whether there is more to do; the figures are there when there is not.
  bool measure();

 private:
  using State = ObjectState;

  void carry_out(const commands::Grab& command);
  void carry_out(const commands::Drag& command);
  void carry_out(const commands::Release& command);
  void carry_out(const commands::SetSoftness& command);
  void carry_out(const commands::SetRelaxation& command);
  void carry_out(const commands::Relax& command);
  void carry_out(const commands::SetAlgorithm& command);
  void carry_out(const commands::Cut& command);
  void carry_out(const commands::Uncut& command);
  void carry_out(const commands::Pin& command);
  void carry_out(const commands::Unpin& command);
  void carry_out(const commands::Reset& command);
  void carry_out(const commands::ReplaceMesh& command);
  void carry_out(const commands::Place& command);
  void carry_out(const commands::SetElastic& command);
  void carry_out(const commands::MoveControlPoint& command);
  void carry_out(const commands::KeepState& command);
  void carry_out(const commands::RestoreState& command);
  void carry_out(const commands::DropState& command);

  std::uint64_t sweep(double step, const Progress& progress);
  void answer();
  void forget_passes();
  void set_softness(std::shared_ptr<const Softness> softness);
  void pass(ElementId element, const Point& target);
  template <class Move>
  void time_pass(Move move);
  void mark(std::span<const ElementId> moved);
  void mark_all();
  State& kept(commands::StateId state);
  void check_element(ElementId element) const;
  void check_links(std::span<const LinkId> links) const;
  void take_mesh(MeshPointer mesh);
  void wake(std::span<const ElementId> elements);
  void wake_ends(const std::vector<LinkId>& links);
  void fall_asleep();
  State current_state();
  void take_state(const State& state);
  void take_cuts(const std::vector<LinkId>& cuts);
  void take_positions(const PositionBlocks& positions);

  MeshPointer mesh_;
  Algorithm algorithm_;
  Precision precision_;
  std::unique_ptr<Solver> solver_;
  std::shared_ptr<const Softness> softness_ = std::make_shared<const Softness>();
  ElasticOptions elastic_;
  ElementBlocks changed_;    // since they were last forgotten
  ElementBlocks away_;       // no element outside them stands away from rest
  PositionBlocks last_kept_;  // as positions were last kept or taken back
  ElementBlocks unkept_;     // the blocks in which a position may have changed since
  std::optional<ElementId> grabbed_;
  std::optional<ElementId> last_moved_;  // the element of the last pass
  bool valid_ = true;
  bool relaxation_on_ = false;
  double relaxation_step_ = 1;
  RelaxationScheme relaxation_scheme_ = RelaxationScheme::mean;
  bool woken_ = false;  // since the last sweep ended
  PassTimes::Clock::time_point relaxation_deadline_{};
  std::map<commands::StateId, State> kept_;
  PassTimes times_;
  std::optional<WholeViolation> measure_;  // as far as it has come
  TouchedViolation touched_;
  Statistics statistics_;
  Trace* trace_ = nullptr;
  Progress progress_;
};

}  // namespace chainmail

#include "report/run/contest.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "measure/hausdorff.h"
#include "measure/shape_measures.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "report/run/drag_times.h"
#include "report/run/memory_in_use.h"
#include "report/table/format.h"

namespace chainmail::report {
namespace {

constexpr int min_repetitions = 3, max_repetitions = 51;
constexpr double longest_repeated_drag = 0.3;  // seconds; slower drags are not repeated, unless their number is given
constexpr double own_limits_residual = 0.01;   // of the iterations to a contestant's own limit, over the wanted share
constexpr std::size_t moves_to_own_limit = 6;
constexpr double rounding_of_handle = 1e-4;  // mean rest lengths; positions are in float

/// Returns true if the handle is where the reference has it.
bool handle_is_there(const Simulation& simulation, const std::vector<ElementId>& handle,
                     const ReferenceSolution& reference) {
  const Mesh& mesh = simulation.mesh();
  const PositionView positions = simulation.body().positions();
  const auto n = std::size_t(mesh.space_dimension);
  return std::ranges::all_of(handle, [&](ElementId element) {
    for (std::size_t k = 0; k < n; ++k) {
      const double target = mesh.rest[element * n + k] + reference.displacements[element * n + k];
      if (!(std::abs(positions(element, int(k)) - target) <= rounding_of_handle * mesh.mean_link_length)) {
        return false;
      }
    }
    return true;
  });
}

std::vector<double> places_of(const Mesh& mesh, const ReferenceSolution& reference) {
  std::vector<double> at = mesh.rest;
  std::ranges::transform(at, reference.displacements, at.begin(), std::plus());
  return at;
}

}  // namespace

PositionView view_of(const Mesh& mesh, const std::vector<double>& positions) {
  return {positions.data(), std::size_t(mesh.space_dimension) * sizeof(double), Precision::double_precision};
}

void add_shape(Row& row, const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& positions,
               const std::optional<PositionView>& reference) {
  if (reference) {
    row.set(figures::hausdorff, hausdorff_distance(mesh, positions, *reference));
  }
  row.set(figures::volume_change, chainmail::volume_change(mesh, positions, cuts));
  row.set(figures::inverted_cells, chainmail::inverted_cells(mesh, positions));
  row.set(figures::stretch, largest_principal_stretch(mesh, positions));
  row.set(figures::violation_max, measure_violation(mesh, softness, cuts, positions).max);
}

std::string left_out_after(double seconds) {
  return "left out after " + figure(seconds) + " s; a contestant that is asked for by name takes as long as it needs";
}

void add_error(Row& row, const PhysicalError& error) {
  row.set(figures::relative, error.relative);
  row.set(figures::error_rms, error.rms);
  row.set(figures::error_max, error.max);
  row.set(figures::moving_rms, error.moving_rms);
  row.set(figures::moving_max, error.moving_max);
  row.set(figures::moving_elements, double(error.moving));
}

void PhysicsReferee::judge(const Runner& runner, const Contestant& /*contestant*/, Row& row) {
  const Simulation& simulation = runner.simulation();
  const Mesh& mesh = simulation.mesh();
  const PositionView positions = simulation.body().positions();
  const std::vector<double> right = places_of(mesh, reference_);
  add_error(row, measure_physical_error(mesh, positions, reference_));
  row.set(figures::reference_change, change_);
  add_shape(row, mesh, simulation.softness(), simulation.body().cuts(), positions, view_of(mesh, right));
}

void PhysicsReferee::judge_nothing(const Case& object, Row& row) {
  const Mesh& mesh = *object.mesh;
  const std::vector<double> at = positions_of_nothing_moving(mesh, reference_), right = places_of(mesh, reference_);
  add_error(row, error_of_nothing_moving(mesh, reference_));
  row.set(figures::reference_change, change_);
  add_shape(row, mesh, object.softness, Cuts(object.mesh), view_of(mesh, at), view_of(mesh, right));
}

/// One contestant with its solver and its times.
class Contest::Participant {
 public:
  Participant(const Case& object, const Contestant& contestant, const ContestOptions& options)
      : object_(object), whole_(object), contestant_(contestant), options_(options) {
    if (!contestant.algorithm) {
      return;
    }
    if (contestant.limit > 0 && !contestant.equilibrium) {
      object_.elastic.iterations = std::uint32_t(contestant.limit);
    }
    object_.softness = softness_of(contestant, object_.softness);
    const auto before = bytes_in_use();
    try {
      runner_ = std::make_unique<Runner>(object_, *contestant.algorithm, options.precision, options);
    } catch (const Error& error) {
      refusal_ = error.what();
    }
    bytes_ = bytes_since(before);
  }

  /// Runs a drag for the first time and measures the errors, within the time that the contestant has left.
  /// `preparations` is null if nothing is timed.
  void begin(const RecordedMoves& moves, Referee* referee, Preparations* preparations, const Progress& progress) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const Progress mine =
        options_.longest > 0 ? progress.until(start + std::chrono::duration_cast<Clock::duration>(left_)) : progress;
    if (mine.is_too_late()) {
      return refuse(left_out());
    }
    limited_ = nullptr;  // of the drag before
    const bool to_own_limit = options_.own_limit > 0 && referee != nullptr && referee->reference() != nullptr;
    if (to_own_limit && has_one_answer()) {
      RecordedMoves fewer = moves;
      keep_moves(fewer.commands, moves_to_own_limit);
      try_out(fewer, referee, preparations, mine);
      limit_iterations(moves, *referee, mine);
    }
    if (limited_ == nullptr && !mine.is_too_late()) {
      try_out(moves, referee, preparations, mine);
      if (to_own_limit) {
        limit_iterations(moves, *referee, mine);
      }
    }
    if (is_measured_ && mine.is_too_late() && limited_ == nullptr) {
      refuse(left_out());  // not all numbers of iterations were tried
    }
    left_ -= Clock::now() - start;
  }

  int repetitions(double seconds) const {
    if (limited_ != nullptr) {
      return limited_->repetitions(seconds);
    }
    if (!is_measured_ || !runner_ || options_.only_errors) {
      return 0;
    }
    if (options_.repetitions) {
      return *options_.repetitions;
    }
    return seconds_ > longest_repeated_drag
               ? 0
               : std::clamp(int(seconds / std::max(seconds_, 1e-6)), min_repetitions, max_repetitions);
  }

  void repeat(const Progress& progress) {
    if (limited_ != nullptr) {
      limited_->repeat(progress);
      return;
    }
    if (!warm_) {
      times_.clear();  // the first run was a warm-up
      warm_ = true;
    }
    run(progress);
  }

  Row result() {
    if (!is_measured_ || !runner_) {
      return std::move(row_);
    }
    Row row = std::move(limited_ != nullptr ? limited_->row_ : row_);
    add_times(row, limited_ != nullptr ? limited_->times_ : times_);
    return row;
  }

 private:
  /// True if the answer after as many iterations as it wants depends on the place of the handle, not on the way there.
  /// Then fewer moves find the own limit, which takes most of the time of a contestant that iterates slowly. Sheets may
  /// wrinkle in several ways. Where a solid buckles in another way, no number comes to that limit, and all moves count.
  bool has_one_answer() const {
    return contestant_.limit == 0 && !limits_of(contestant_).empty() &&
           (prepares(contestant_) || contestant_.open_regions) && object_.mesh->object_dimension == 3;
  }

  /// Runs a drag for the first time and measures the errors.
  void try_out(const RecordedMoves& moves, Referee* referee, Preparations* preparations, const Progress& progress) {
    row_ = {.contestant = contestant_, .refusal = refusal_};
    times_.clear();
    warm_ = false;
    limited_ = nullptr;
    if (!contestant_.algorithm) {
      if (referee != nullptr) {
        referee->judge_nothing(object_, row_);
      }
      return;
    }
    if (!runner_) {
      return;
    }
    try {
      has_cut_ = !cuts_of(moves).empty();
      moves_ = prepares(contestant_) ? with_preparing_move(*object_.mesh, moves) : moves;
      const auto before = bytes_in_use();
      if (!options_.only_errors && !prepares(contestant_)) {
        run(progress);  // prepares, so that no time of the next run contains this
        times_.clear();
      }
      run(progress);
      bytes_ = has_run_ ? bytes_ : sum_of(bytes_, bytes_since(before));
      has_run_ = true;
      measure(referee, progress);
      if (is_measured_ && preparations != nullptr && !progress.cancelled()) {
        prepare_ = prepared(*preparations).of(handle_of(moves));  // last, because nothing cancels it
      }
    } catch (const Error& error) {
      refuse(error.what());
    }
  }

  /// Call this after try_out(). From now on the drag runs with the least number of iterations per move with which the
  /// answer at its end is close to that of try_out(), the own limit.
  void limit_iterations(const RecordedMoves& moves, Referee& referee, const Progress& progress) {
    if (!is_measured_ || contestant_.limit > 0) {
      return;
    }
    ReferenceSolution own = *referee.reference();  // its own converged answer, which each number is compared with
    own.displacements = displacements();
    PhysicsReferee own_limit(own);
    for (const int limit : limits_of(contestant_)) {
      Participant& one = limited_to(limit);
      one.try_out(moves, &own_limit, nullptr, progress);
      if (one.is_measured_ && one.row_[figures::relative] <= options_.own_limit) {
        one.measure(&referee, progress);
        one.row_.contestant = contestant_;
        one.row_.set(figures::iterations, double(limit));
        limited_ = &one;
        return;
      }
    }
  }

  void add_times(Row& row, const RepeatedDrag& times) const {
    row.set(figures::ms_per_move, times.spread(&DragTimes::mean));
    row.set(figures::worst_move_ms, times.slowest_move(prepares(contestant_)));
    row.set(figures::first_ms, times.spread(&DragTimes::first));
    if (count_moves(moves_) > (prepares(contestant_) ? 2 : 1) + (has_cut_ ? 1 : 0)) {
      row.set(figures::later_ms, times.spread(&DragTimes::later));
    }
    if (has_cut_) {
      row.set(figures::after_cut_ms, times.spread(&DragTimes::after_cut));
    }
    row.set(figures::factorize_ms, prepare_.factorize);
    row.set(figures::grab_ms, prepare_.grab);
    if (prepare_.factorize.count > 0) {
      row.set(figures::prepare_ms, prepare_.ms());
    }
    if (const auto first = row[figures::first_ms]) {
      row.set(figures::fresh_ms, *first + prepare_.grab.median);
    }
  }

  /// Returns the times of preparation for the object and all its handles. Measures them for the first contestant of
  /// those that share them.
  const PreparingTimes& prepared(Preparations& preparations) const {
    const Contestant shared = curve_of(contestant_);
    const auto found = std::ranges::find(preparations, shared, &Preparations::value_type::first);
    if (found != preparations.end()) {
      return found->second;
    }
    const Algorithm method = *contestant_.algorithm;
    const double seconds = std::min(enough_preparing, options_.seconds);
    return preparations
        .emplace_back(shared, info(method).elastic
                                  ? PreparingTimes(object_, method, seconds, options_.clocks)
                                  : PreparingTimes(object_, method, contestant_.equilibrium, seconds, options_))
        .second;
  }

  Participant& limited_to(int limit) {
    std::unique_ptr<Participant>& one = by_limit_[limit];
    if (!one) {
      Contestant contestant = contestant_;
      contestant.limit = limit;
      one = std::make_unique<Participant>(whole_, contestant, options_);
    }
    return *one;
  }

  /// The displacements at the end of the last run.
  std::vector<double> displacements() const {
    const PositionView at = runner_->simulation().body().positions();
    const auto n = std::size_t(object_.mesh->space_dimension);
    std::vector<double> displacements(object_.mesh->rest.size());
    for (std::size_t i = 0; i < displacements.size(); ++i) {
      displacements[i] = at(ElementId(i / n), int(i % n)) - object_.mesh->rest[i];
    }
    return displacements;
  }

  Relaxing relaxing() const {
    Relaxing relaxing(contestant_.sweeps, contestant_.equilibrium);
    relaxing.iterations = contestant_.limit > 0 ? contestant_.limit : relaxing.iterations;
    if (options_.own_limit > 0) {
      relaxing.until = own_limits_residual * options_.own_limit;  // the own limit itself must be closer than that
    }
    return relaxing;
  }

  void run(const Progress& progress) {
    const double start = options_.clocks.wall();
    last_ = runner_->run(moves_, relaxing(), progress, contestant_.limit == 0);
    if (last_.stopped) {
      return;
    }
    const DragTimes times = split(last_.ms, prepares(contestant_), has_cut_);
    // Without a cut, the repetitions of the drag do not prepare again.
    seconds_ = options_.clocks.wall() - start - (has_cut_ ? 0 : times.preparing / 1e3);
    times_.add(times, last_.ms);
  }

  void refuse(const std::string& reason) {
    row_ = {.contestant = contestant_, .refusal = reason};
    is_measured_ = false;
    limited_ = nullptr;  // nothing is repeated
  }

  /// Returns why the answer has no figures: a contestant that did not converge, by its own rule, unless its iterations
  /// are limited.
  std::string fault(const ReferenceSolution* reference) {
    const Simulation& simulation = runner_->simulation();
    const bool is_elastic = info(*contestant_.algorithm).elastic.has_value();
    const bool has_missed = reference != nullptr && !handle_is_there(simulation, runner_->handle(), *reference);
    const std::string& remark = simulation.statistics().remark;
    if (!remark.empty() && (reference != nullptr || is_elastic) && (contestant_.limit == 0 || has_missed)) {
      return remark;
    }
    const auto equilibrium = contestant_.equilibrium ? runner_->certificate() : std::nullopt;
    return contestant_.limit == 0 && reference != nullptr && equilibrium && equilibrium->residual > compared_residual
               ? "it did not reach the residual in " + std::to_string(equilibrium_iterations) + " iterations"
               : "";
  }

  void measure(Referee* referee, const Progress& progress) {
    row_ = {.contestant = contestant_};
    is_measured_ = false;
    if (last_.stopped) {
      row_.refusal = progress.is_too_late() ? left_out() : "";
      return;
    }
    if (const std::string reason = fault(referee != nullptr ? referee->reference() : nullptr); !reason.empty()) {
      return refuse(reason);
    }
    const double moves = std::max(1, count_moves(moves_));
    row_.set(figures::checked, double(last_.checked) / moves);
    row_.set(figures::moved, double(last_.moved) / moves);
    if (bytes_) {
      row_.set(figures::bytes, double(*bytes_));
    }
    if (const auto equilibrium = contestant_.equilibrium ? runner_->certificate() : std::nullopt) {
      row_.set(figures::residual, equilibrium->residual);
      row_.set(figures::binds, equilibrium->binds ? 1.0 : 0.0);
    }
    if (referee != nullptr) {
      referee->judge(*runner_, contestant_, row_);
    }
    is_measured_ = std::isfinite(row_[figures::relative].value_or(0));
    if (!is_measured_) {
      refuse("its positions are not numbers: it diverged");
    }
  }

  std::string left_out() const { return left_out_after(options_.longest); }

  Case object_;        // with the softness of the contestant
  const Case& whole_;  // as it was given
  Contestant contestant_;
  ContestOptions options_;
  std::map<int, std::unique_ptr<Participant>> by_limit_;  // by the number of iterations
  std::unique_ptr<Runner> runner_;
  std::string refusal_;
  std::optional<std::uint64_t> bytes_;                                                    // held after the first drag
  std::chrono::duration<double> left_ = std::chrono::duration<double>(options_.longest);  // of its time
  bool has_run_ = false;
  // State of the current drag:
  Row row_;
  bool is_measured_ = false;
  Preparation prepare_;
  RecordedMoves moves_;
  bool has_cut_ = false;
  Runner::Run last_;
  RepeatedDrag times_;
  double seconds_ = 0;
  bool warm_ = false;
  Participant* limited_ = nullptr;  // runs in place of this one; one of by_limit_
};

Contest::Contest(const Case& object, const std::vector<Contestant>& contestants, const ContestOptions& options)
    : options_(options) {
  for (const Contestant& contestant : contestants) {
    participants_.push_back(std::make_unique<Participant>(object, contestant, options_));
  }
}

Contest::~Contest() = default;

std::vector<Row> Contest::run(const RecordedMoves& moves, Referee* referee, const Progress& progress) {
  const double count = double(participants_.size());
  for (std::size_t i = 0; i < participants_.size() && !progress.cancelled(); ++i) {
    progress.show(0.5 * double(i) / count);
    participants_[i]->begin(moves, referee, options_.only_errors ? nullptr : &preparations_, progress);
  }
  // Contestants run in turns, so that other load on the machine affects all of them equally. Slow contestants repeat
  // less often.
  const double most = options_.repetitions.value_or(max_repetitions);
  for (int repetition = 0, left = 1; left > 0 && !progress.cancelled(); ++repetition) {
    progress.show(0.5 + 0.5 * std::min(1.0, repetition / most));
    left = 0;
    for (std::size_t turn = 0; turn < participants_.size(); ++turn) {
      Participant& one = *participants_[(turn + std::size_t(repetition)) % participants_.size()];
      if (repetition < one.repetitions(options_.seconds / count) && !progress.cancelled()) {
        one.repeat(progress);
        ++left;
      }
    }
  }
  std::vector<Row> rows;
  for (const auto& participant : participants_) {
    rows.push_back(participant->result());
  }
  return rows;
}

}  // namespace chainmail::report

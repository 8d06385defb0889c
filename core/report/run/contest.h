#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "measure/physical_error.h"
#include "report/run/preparing.h"
#include "report/table/results.h"

namespace chainmail::report {

/// A contestant makes the least number of iterations per move with which its answer at the end of a drag is within this
/// share of its own limit, the answer after as many as it wants.
inline constexpr double own_limit_of_comparisons = 0.01;

/// What a contest measures, and how long it may take.
struct ContestOptions : RunOptions {
  /// Number of repetitions of each drag, without the warm-up; none: as many as fit in `seconds`, at least 3.
  std::optional<int> repetitions = {};
  double seconds = 4;  // total time for the repetitions of one drag with all contestants
  /// Share of the way that ends the iterations of every contestant alike: see own_limit_of_comparisons. 0: each stops
  /// by its own rule.
  double own_limit = 0;
  double longest = 0;        // seconds that a contestant may take on one object; 0: as long as it needs
  bool only_errors = false;  // true: no preparation is timed, and no drag is repeated
};

/// Returns the refusal of a contestant that needs more time than ContestOptions::longest.
std::string left_out_after(double seconds);

/// Measures the answers of contestants at the end of a drag.
class Referee {
 public:
  virtual ~Referee() = default;
  /// Adds the errors of a contestant whose run has just ended.
  virtual void judge(const Runner& runner, const Contestant& contestant, Row& row) = 0;
  /// Adds those of an object in which only the handle and the pins moved.
  virtual void judge_nothing(const Case& /*object*/, Row& /*row*/) {}
  /// The solution that answers are compared with; null if it is none of physics.
  virtual const ReferenceSolution* reference() const { return nullptr; }
};

/// Compares answers with a solution of physics.
class PhysicsReferee : public Referee {
 public:
  /// `change` is that of the reference by its last refinement. Both must outlive this.
  explicit PhysicsReferee(const ReferenceSolution& reference, const std::optional<double>& change = {})
      : reference_(reference), change_(change) {}

  void judge(const Runner& runner, const Contestant& contestant, Row& row) override;
  void judge_nothing(const Case& object, Row& row) override;
  const ReferenceSolution* reference() const override { return &reference_; }

 private:
  const ReferenceSolution& reference_;
  std::optional<double> change_;
};

/// Returns a view of the positions of all elements, space_dimension coordinates each.
PositionView view_of(const Mesh& mesh, const std::vector<double>& positions);
/// Adds figures about the shape, with a reference for the Hausdorff distance if there is one.
void add_shape(Row& row, const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& positions,
               const std::optional<PositionView>& reference);
/// Adds errors against physics.
void add_error(Row& row, const PhysicalError& error);

/// Runs all contestants on one object, drag by drag. Each contestant keeps its preparation for the object and for a
/// handle.
class Contest {
 public:
  /// The object must outlive the contest. A contestant that cannot take part is listed with the reason.
  Contest(const Case& object, const std::vector<Contestant>& contestants, const ContestOptions& options);
  ~Contest();

  /// Runs a drag with all contestants, and returns a row for each. Without a referee, times alone.
  std::vector<Row> run(const RecordedMoves& moves, Referee* referee, const Progress& progress);

 private:
  class Participant;
  /// Times of preparation. Contestants that differ in their iterations or sweeps share them.
  using Preparations = std::vector<std::pair<Contestant, PreparingTimes>>;

  ContestOptions options_;
  Preparations preparations_;
  std::vector<std::unique_ptr<Participant>> participants_;
};

}  // namespace chainmail::report

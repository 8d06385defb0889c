#include <algorithm>
#include <chrono>
#include <cmath>

#include "mesh/error.h"
#include "report/run/contest.h"
#include "report/run/preparing.h"

namespace chainmail::report {
namespace {

constexpr std::uint64_t smallest_object = 100, largest_object = 1'000'000;  // elements
constexpr double next_size = 2;
constexpr double asymptotic_from =
    1000;  // elements; in smaller objects, the fixed cost of a pass is too large a part of the time
const std::vector<int> sweeps_grown{0, 10};
constexpr std::size_t moves_grown = 6;  // number of moves of the drag, which are longer than usual
constexpr const char* drag_grown = "pull";

double growth_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Keeps only the pull, with few moves, so that runs are short.
void shorten(Case& object) {
  RecordedMoves pull = *std::ranges::find(object.drags, drag_grown, &RecordedMoves::name);
  std::vector<Command> commands{pull.commands.front()};
  const std::size_t every = (pull.commands.size() - 1) / moves_grown;
  for (std::size_t i = every; i < pull.commands.size(); i += every) {
    commands.push_back(pull.commands[i]);
  }
  pull.commands = std::move(commands);
  object.drags = {std::move(pull)};
}

/// Remaining time of a contestant, with an estimate for the next size.
class Budget {
 public:
  explicit Budget(double seconds) : left_(seconds) {}

  void spend(double seconds) {
    left_ -= seconds;
    // Assumes that the time grows as it did last, at least in proportion to the elements and at most like a dense
    // factorization.
    ratio_ = last_ > 0 ? std::clamp(seconds / last_, next_size, 8.0) : next_size;
    last_ = seconds;
  }
  bool holds_next() const { return left_ > 0 && last_ * ratio_ <= left_; }
  void use_up() { left_ = 0; }

 private:
  double left_, last_ = 0, ratio_ = next_size;
};

/// Returns the reference solution for an object; none if its time budget is used up or there is no solution.
std::optional<ReferenceSolution> reference_at(const Case& object, Budget& budget) {
  if (!budget.holds_next()) {
    return std::nullopt;
  }
  const double start = growth_clock();
  try {
    ReferenceSolver solver(reference_problem(object));
    const auto& commands = object.drags.front().commands;
    ReferenceSolution reference = solver.at(std::get<commands::Grab>(commands.front()).elements.front(),
                                            std::get<commands::Drag>(commands.back()).target);
    budget.spend(growth_clock() - start);
    return reference;
  } catch (const Error&) {
    budget.use_up();  // the object is too large
    return std::nullopt;
  }
}

/// Returns a substitute for a missing reference solution, for runs of which only the times are used.
ReferenceSolution no_reference(const Case& object) {
  return {std::vector<double>(object.mesh->rest.size(), 0.0), 1, {}};
}

void measure(GrowthSeries& series, Budget& budget, const Case& object,
             const std::optional<ReferenceSolution>& reference, CompareOptions options, const Progress& progress) {
  const double start = growth_clock();
  options.seconds = 0;
  options.repetitions = 1;
  Contest contest(object, {series.contestant}, options);
  const auto entries =
      contest.run(object.drags.front(), reference ? *reference : no_reference(object), progress.quiet());
  budget.spend(growth_clock() - start);
  if (const auto& measurement = entries.front().measurement) {
    series.points.push_back({object.mesh->element_count(), measurement->ms_per_move.median, measurement->prepare.ms(),
                             reference ? std::optional(measurement->error) : std::nullopt});
    series.end = budget.holds_next() ? "" : "its time budget is used up";
  } else if (!progress.cancelled()) {
    series.end = entries.front().refusal;
    budget.use_up();
  }
}

void find_growth(GrowthSeries& series) {
  std::vector<SizedTime> times;
  for (const GrowthPoint& point : series.points) {
    times.push_back({double(point.elements), point.ms_per_move});
  }
  series.growth = growth_of(times, asymptotic_from);
}

}  // namespace

PhysicsGrowth grow(const std::string& name, const std::string& description,
                   const std::function<Case(std::uint64_t elements)>& made, const PhysicsOptions& options,
                   const Progress& progress) {
  PhysicsGrowth growth{name, description, {}};
  std::vector<Budget> budgets;
  for (const PhysicsContestant& contestant :
       contestants_of(options.contest.algorithms, sweeps_grown, options.contest.equilibrium, {})) {
    if (!contestant.algorithm) {
      continue;  // its relative error is about 1 at every size, and it has no times
    }
    growth.series.push_back({contestant, {}, {}, {}});
    budgets.emplace_back(options.growth_seconds);
  }
  Budget of_reference(options.growth_seconds);
  const double sizes = std::log(double(largest_object) / smallest_object) / std::log(next_size);
  double size = smallest_object;
  for (int i = 0; size <= largest_object && std::ranges::any_of(budgets, &Budget::holds_next); ++i, size *= next_size) {
    progress.show(i / (sizes + 1));
    Case object = made(static_cast<std::uint64_t>(size));
    shorten(object);
    const auto reference = reference_at(object, of_reference);
    for (std::size_t k = 0; k < budgets.size() && !progress.cancelled(); ++k) {
      if (budgets[k].holds_next()) {
        measure(growth.series[k], budgets[k], object, reference, options.contest, progress);
      }
    }
    if (progress.cancelled()) {
      break;
    }
  }
  for (GrowthSeries& series : growth.series) {
    find_growth(series);
    series.end = series.end.empty() ? "this is the largest object" : series.end;
  }
  return growth;
}

}  // namespace chainmail::report

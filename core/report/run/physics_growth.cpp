#include <algorithm>
#include <chrono>
#include <cmath>

#include "mesh/error.h"
#include "report/run/physics.h"
#include "report/table/format.h"

namespace chainmail::report {
namespace {

constexpr std::uint64_t smallest_object = 100, largest_object = 1'000'000;  // elements
constexpr double next_size = 2;
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

/// Measures a contestant on an object of a series. Returns a row with figures, or the reason why there are none.
Row measure(const Contestant& contestant, Budget& budget, const Case& object,
            const std::optional<ReferenceSolution>& reference, ContestOptions options, const Progress& progress) {
  const double start = growth_clock();
  options.repetitions = 0;
  options.own_limit = 0;
  options.longest = 0;  // the budget limits it
  std::optional<PhysicsReferee> referee;
  if (reference) {
    referee.emplace(*reference);
  }
  Contest contest(object, {contestant}, options);
  Row row = contest.run(object.drags.front(), referee ? &*referee : nullptr, progress.quiet()).front();
  budget.spend(growth_clock() - start);
  if (!row.has_figures()) {
    budget.use_up();
  }
  return row;
}

}  // namespace

Results grow(const std::string& name, const std::string& description,
             const std::function<Case(std::uint64_t elements)>& made, const PhysicsOptions& options,
             const Progress& progress) {
  Results results;
  std::vector<Contestant> contestants = contestants_of(options.algorithms, sweeps_grown, options.equilibrium, {});
  contestants.erase(contestants.begin());  // the object that does not move has about the same error at every size
  std::vector<Budget> budgets(contestants.size(), Budget(options.growth_seconds));
  Budget of_reference(options.growth_seconds);
  const double sizes = std::log(double(largest_object) / smallest_object) / std::log(next_size);
  double size = smallest_object;
  for (int i = 0; size <= largest_object && std::ranges::any_of(budgets, &Budget::holds_next) && !progress.cancelled();
       ++i, size *= next_size) {
    progress.show(i / (sizes + 1));
    Case object = made(static_cast<std::uint64_t>(size));
    shorten(object);
    const auto reference = reference_at(object, of_reference);
    ObjectInfo& grown = results.objects.emplace_back(info_of(object));
    grown.series = name;
    grown.description = description;
    grown.name = name + ", " + thousands(grown.elements) + " elements";
    std::vector<Row> rows;
    for (std::size_t k = 0; k < budgets.size() && !progress.cancelled(); ++k) {
      if (budgets[k].holds_next()) {
        rows.push_back(measure(contestants[k], budgets[k], object, reference, options, progress));
      }
    }
    add_drag(results, info_of(object.drags.front()), std::move(rows));
  }
  return results;
}

}  // namespace chainmail::report

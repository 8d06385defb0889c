#include "report/run/ramp.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/error.h"
#include "mesh/generate.h"
#include "report/run/ramp_rule.h"
#include "report/run/scripted_drags.h"

namespace chainmail::report {
namespace {

constexpr std::uint32_t first_width = 4;

/// Returns the widths of the square grids of up to `largest` elements.
std::vector<std::uint32_t> widths_up_to(std::uint64_t largest) {
  std::vector<std::uint32_t> widths;
  for (std::uint32_t width = first_width; std::uint64_t{width} * width <= largest; width = next_width(width)) {
    widths.push_back(width);
  }
  return widths;
}

/// The mesh of one size, with its solvers. The list-driven algorithms share one solver to save memory.
class RampSize {
 public:
  RampSize(std::uint32_t width, const RampOptions& options)
      : options_(options), mesh_(generate({MeshKind::grid, {width, width, 1}, 1, {}})) {}

  const MeshPointer& mesh() const { return mesh_; }

  /// Returns the solver for an algorithm, with the mesh at rest.
  Deformer& solver(Algorithm algorithm) {
    auto& solver = algorithm == Algorithm::exact ? exact_ : by_lists_;
    if (!solver) {
      solver = std::make_unique<Deformer>(mesh_, algorithm, options_.precision);
      solver->body().set_softness({options_.softness, {}});
    }
    solver->set_algorithm(algorithm);
    solver->body().reset();
    return *solver;
  }

 private:
  const RampOptions& options_;
  MeshPointer mesh_;
  std::unique_ptr<Deformer> by_lists_, exact_;
};

class RampRun {
 public:
  RampRun(const RampOptions& options, const std::function<void(const RampProgress&)>& progress, const Progress& job)
      : progress_(progress), job_(job) {
    result_.options = options;
    if (options.algorithms.empty()) {
      for (const AlgorithmInfo& one : algorithms()) {
        result_.options.algorithms.push_back(one.algorithm);
      }
    }
  }

  Ramp run() {
    const RampOptions& options = result_.options;
    const double start = now();
    RampRace race(widths_up_to(options.largest), options.algorithms, options.budget);
    while (!race.is_over() && !job_.cancelled()) {
      measure(race);
    }
    result_.stopped = job_.cancelled();
    for (const Algorithm algorithm : options.algorithms) {
      result_.verdicts.push_back(ramp_verdict(algorithm, result_.rows));
    }
    result_.seconds = now() - start;
    return std::move(result_);
  }

 private:
  double now() const { return result_.options.clocks.wall(); }

  /// Measures one size, with a second attempt if needed.
  void measure(RampRace& race) {
    RampSize size(race.width(), result_.options);
    std::vector<RampRace::Result> results;
    while (results.empty()) {
      const std::vector<RampPasses> passes = attempt(size, race);
      if (job_.cancelled()) {
        return;
      }
      results = race.finish_attempt(*size.mesh(), passes);
    }
    std::ranges::sort(results, {}, [](const RampRace::Result& one) { return one.row.algorithm; });
    for (const RampRace::Result& one : results) {
      result_.rows.push_back(one.row);
    }
  }

  /// Runs one contestant after another. If they alternated, each would find its data displaced from the cache by the
  /// one before.
  std::vector<RampPasses> attempt(RampSize& size, const RampRace& race) {
    const RampOptions& options = result_.options;
    const auto drags = scripted_drags(*size.mesh(), ramp_seed(options.seed, race.width(), race.attempt()),
                                      options.drags + 1, options.moves);
    std::vector<RampPasses> measured(race.attempting().size());
    const auto all = static_cast<int>(drags.size() * measured.size());
    const std::vector<Algorithm> in_race = algorithms_of(race.in_race());
    int done = 0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const Algorithm algorithm = options.algorithms[race.attempting()[i]];
      for (std::size_t drag = 0; drag < drags.size() && !job_.cancelled(); ++drag, ++done) {
        if (progress_) {
          progress_({race.width(), done, all, race.attempt() > 0, in_race, result_.rows});
        }
        const RampPasses passes = make(size.solver(algorithm), drags[drag]);
        if (drag > 0) {  // the first drag allocates the memory of the others
          measured[i].ms.insert(measured[i].ms.end(), passes.ms.begin(), passes.ms.end());
          measured[i].moved += passes.moved;
        }
      }
    }
    return measured;
  }

  std::vector<Algorithm> algorithms_of(const std::vector<std::size_t>& contestants) const {
    std::vector<Algorithm> found;
    found.reserve(contestants.size());
    for (const std::size_t contestant : contestants) {
      found.push_back(result_.options.algorithms[contestant]);
    }
    return found;
  }

  RampPasses make(Deformer& solver, const ScriptedDrag& drag) const {
    RampPasses passes;
    for (const Point& target : drag.targets) {
      if (job_.cancelled()) {
        break;
      }
      const auto move = [&] { passes.moved += solver.move(drag.element, target).moved; };
      passes.ms.push_back(1000 * seconds_of(result_.options.clocks, move));
    }
    return passes;
  }

  const std::function<void(const RampProgress&)>& progress_;
  const Progress& job_;
  Ramp result_;
};

}  // namespace

std::uint32_t next_width(std::uint32_t width) { return width + std::max(1U, (width + 5) / 10); }

Ramp ramp(const RampOptions& options, const std::function<void(const RampProgress&)>& progress, const Progress& job) {
  return RampRun(options, progress, job).run();
}

void check(const RampOptions& options) {
  constexpr std::uint64_t smallest_grid = 16;
  const auto check_range = [](const char* name, bool is_in_range, const char* problem, const char* what_to_do) {
    if (!is_in_range) {
      throw Error(name, problem, what_to_do);
    }
  };
  for (const Algorithm algorithm : options.algorithms) {
    if (info(algorithm).family() != Family::chainmail) {
      throw Error("method '" + std::string(info(algorithm).offered_name()) + "'", "it is not of the ChainMail family",
                  "use one that is");
    }
  }
  check_range("budget", options.budget > 0 && std::isfinite(options.budget), "it is not a number above 0",
              "use a number of seconds, such as 1 / 60");
  check_range("largest", options.largest >= smallest_grid && options.largest <= element_limit,
              "no grid has so many elements", "use 16 to 20000000");
  check_range("drags", options.drags >= 1, "it is below 1", "use 1 or more");
  check_range("moves", options.moves >= 1, "it is below 1", "use 1 or more");
  chainmail::check(options.softness);
}

}  // namespace chainmail::report

#include "report/run/ramp.h"

#include <algorithm>
#include <map>

#include "mesh/generate.h"
#include "report/run/hand.h"
#include "report/run/ramp_rule.h"

namespace chainmail::report {
namespace {

constexpr std::uint32_t first_width = 4;

/// One size: its mesh, and solvers on it. The algorithms that work on lists share one, for memory's sake.
class Size {
 public:
  Size(std::uint32_t width, const RampOptions& options)
      : options_(options), mesh_(generate({MeshKind::grid, {width, width, 1}, 1, {}})) {}

  const MeshPointer& mesh() const { return mesh_; }

  /// At rest, under this algorithm.
  Solver& solver(Algorithm algorithm) {
    auto& solver = algorithm == Algorithm::exact ? exact_ : by_lists_;
    if (!solver) {
      solver = make_solver(mesh_, algorithm, options_.precision);
      solver->set_softness({options_.softness, {}});
    }
    solver->set_algorithm(algorithm);
    solver->reset();
    return *solver;
  }

 private:
  const RampOptions& options_;
  MeshPointer mesh_;
  std::unique_ptr<Solver> by_lists_, exact_;
};

class Run {
 public:
  Run(const RampOptions& options, const std::function<void(const RampProgress&)>& progress, const std::stop_token& stop)
      : progress_(progress), stop_(stop) {
    result_.options = options;
    if (options.algorithms.empty()) {
      for (const AlgorithmInfo& one : algorithms()) {
        result_.options.algorithms.push_back(one.algorithm);
      }
    }
    in_race_ = result_.options.algorithms;
  }

  Ramp run() {
    const double start = now();
    for (std::uint32_t width = first_width;
         !in_race_.empty() && std::uint64_t{width} * width <= result_.options.largest && !stop_.stop_requested();
         width = next_width(width)) {
      measure(width);
    }
    result_.stopped = stop_.stop_requested();
    for (const Algorithm algorithm : result_.options.algorithms) {
      result_.verdicts.push_back(ramp_verdict(algorithm, result_.rows));
    }
    result_.seconds = now() - start;
    return std::move(result_);
  }

 private:
  using Measured = std::map<Algorithm, RampPasses>;

  double now() const { return result_.options.clocks.wall(); }

  void measure(std::uint32_t width) {
    Size size(width, result_.options);
    std::vector<RampRow> rows;
    for (const auto& [algorithm, passes] : attempt(size, width, in_race_, 0)) {
      rows.push_back(row(*size.mesh(), width, algorithm, passes));
    }
    std::vector<Algorithm> missed;
    for (const RampRow& one : rows) {
      if (!one.in_real_time) {
        missed.push_back(one.algorithm);
      }
    }
    const Measured again = attempt(size, width, missed, 1);
    if (stop_.stop_requested()) {
      return;
    }
    for (RampRow& one : rows) {
      if (const auto found = again.find(one.algorithm); found != again.end()) {
        one = row(*size.mesh(), width, one.algorithm, found->second);
        one.repeated = true;
      }
    }
    take(rows);
  }

  void take(const std::vector<RampRow>& rows) {
    result_.rows.insert(result_.rows.end(), rows.begin(), rows.end());
    for (const RampRow& one : rows) {
      if (!one.in_real_time) {
        std::erase(in_race_, one.algorithm);
      }
    }
  }

  Measured attempt(Size& size, std::uint32_t width, const std::vector<Algorithm>& contestants, int number) {
    const RampOptions& options = result_.options;
    const auto drags =
        hand_drags(*size.mesh(), ramp_seed(options.seed, width, number), options.drags + 1, options.moves);
    Measured measured;
    const auto all = static_cast<int>(drags.size() * contestants.size());
    int done = 0;
    // One after another: in turns, each would find its memory driven from the cache by the one before.
    for (const Algorithm algorithm : contestants) {
      for (std::size_t i = 0; i < drags.size() && !stop_.stop_requested(); ++i, ++done) {
        if (progress_) {
          progress_({width, done, all, number > 0, in_race_, result_.rows});
        }
        const RampPasses passes = make(size.solver(algorithm), drags[i]);
        // The first drag takes the memory that the others then find.
        if (RampPasses& of_all = measured[algorithm]; i > 0) {
          of_all.ms.insert(of_all.ms.end(), passes.ms.begin(), passes.ms.end());
          of_all.moved += passes.moved;
        }
      }
    }
    return measured;
  }

  RampPasses make(Solver& solver, const HandDrag& drag) const {
    RampPasses passes;
    for (const Point& target : drag.targets) {
      if (stop_.stop_requested()) {
        break;
      }
      const auto move = [&] { passes.moved += solver.move(drag.element, target).moved; };
      passes.ms.push_back(1000 * seconds_of(result_.options.clocks, move));
    }
    return passes;
  }

  RampRow row(const Mesh& mesh, std::uint32_t width, Algorithm algorithm, const RampPasses& passes) const {
    return ramp_row(mesh, width, algorithm, passes, result_.options.budget);
  }

  const std::function<void(const RampProgress&)>& progress_;
  const std::stop_token& stop_;
  Ramp result_;
  std::vector<Algorithm> in_race_;
};

}  // namespace

std::uint32_t next_width(std::uint32_t width) { return width + std::max(1U, (width + 5) / 10); }

Ramp ramp(const RampOptions& options, const std::function<void(const RampProgress&)>& progress,
          const std::stop_token& stop) {
  return Run(options, progress, stop).run();
}

}  // namespace chainmail::report

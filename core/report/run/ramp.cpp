#include "report/run/ramp.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/scattered.h"
#include "report/run/scripted_drags.h"
#include "report/table/growth.h"

namespace chainmail::report {
namespace {

constexpr std::uint32_t first_width = 4;
constexpr double percentile_kept = 0.99;

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

std::vector<Setting> settings_of(const RampOptions& options) {
  return {{"seed", double(options.seed)},
          {"budget", options.budget},
          {"precision", std::string(name(options.precision))},
          {"compression", options.softness.compression},
          {"stretch", options.softness.stretch},
          {"shear", options.softness.shear},
          {"drags", double(options.drags)},
          {"moves", double(options.moves)},
          {"largest", double(options.largest)}};
}

class RampRun {
 public:
  RampRun(const RampOptions& options, const Progress& progress) : options_(options), progress_(progress) {
    if (options_.algorithms.empty()) {
      for (const AlgorithmInfo& one : algorithms()) {
        options_.algorithms.push_back(one.algorithm);
      }
    }
  }

  Results run() {
    const double start = options_.clocks.wall();
    RampRace race(widths_up_to(options_.largest), options_.algorithms, options_.budget);
    while (!race.is_over() && !progress_.cancelled()) {
      measure(race);
    }
    results_.stopped = progress_.cancelled();
    results_.settings = settings_of(options_);
    results_.settings.emplace_back("seconds", options_.clocks.wall() - start);
    return std::move(results_);
  }

 private:
  /// Measures one size, with a second attempt if needed.
  void measure(RampRace& race) {
    RampSize size(race.width(), options_);
    std::vector<Row> rows;
    while (rows.empty()) {
      const std::vector<RampPasses> passes = attempt(size, race);
      if (progress_.cancelled()) {
        return;
      }
      rows = race.finish_attempt(passes);
    }
    const Mesh& mesh = *size.mesh();
    const std::string width = std::to_string(mesh.lattice->size[0]);
    results_.objects.push_back({.name = width + "x" + width,
                                .series = "square grid",
                                .elements = mesh.element_count(),
                                .links = mesh.link_count(),
                                .drags = {{.name = "scripted", .moves = options_.drags * options_.moves}}});
    for (Row& row : rows) {
      row.object = results_.objects.size() - 1;
      row.drag = 0;
      results_.rows.push_back(std::move(row));
    }
  }

  /// Runs one algorithm after another. If they alternated, each would find its data displaced from the cache by the
  /// one before.
  std::vector<RampPasses> attempt(RampSize& size, const RampRace& race) {
    const auto drags = scripted_drags(*size.mesh(), ramp_seed(options_.seed, race.width(), race.attempt()),
                                      options_.drags + 1, options_.moves);
    std::vector<RampPasses> measured(race.attempting().size());
    for (std::size_t i = 0; i < measured.size(); ++i) {
      for (std::size_t drag = 0; drag < drags.size() && !progress_.cancelled(); ++drag) {
        tell(race, i * drags.size() + drag, measured.size() * drags.size());
        const RampPasses passes = make(size.solver(race.attempting()[i]), drags[drag]);
        if (drag > 0) {  // the first drag allocates the memory of the others
          measured[i].ms.insert(measured[i].ms.end(), passes.ms.begin(), passes.ms.end());
          measured[i].moved += passes.moved;
        }
      }
    }
    return measured;
  }

  void tell(const RampRace& race, std::size_t done, std::size_t all) const {
    const std::string width = std::to_string(race.width());
    progress_.say(width + "x" + width + ", drag " + std::to_string(done) + " of " + std::to_string(all) +
                  (race.attempt() > 0 ? ", repeated" : "") +
                  ", in real time so far: " + std::to_string(race.in_race().size()));
    progress_.show(std::min(1.0, double(race.width()) * race.width() / double(options_.largest)));
  }

  RampPasses make(Deformer& solver, const ScriptedDrag& drag) const {
    RampPasses passes;
    for (const Point& target : drag.targets) {
      if (progress_.cancelled()) {
        break;
      }
      const auto move = [&] { passes.moved += solver.move(drag.element, target).moved; };
      passes.ms.push_back(1000 * seconds_of(options_.clocks, move));
    }
    return passes;
  }

  RampOptions options_;
  const Progress& progress_;
  Results results_{.kind = ReportKind::ramp};
};

}  // namespace

std::uint32_t next_width(std::uint32_t width) { return width + std::max(1U, (width + 5) / 10); }

std::uint32_t width_of(const ObjectInfo& grid) { return std::uint32_t(std::lround(std::sqrt(double(grid.elements)))); }

Results ramp(const RampOptions& options, const Progress& progress) { return RampRun(options, progress).run(); }

void check(const RampOptions& options) {
  for (const Algorithm algorithm : options.algorithms) {
    if (info(algorithm).family() != Family::chainmail) {
      throw Error("method '" + std::string(info(algorithm).offered_name()) + "'", "it is not of the ChainMail family",
                  "use one that is");
    }
  }
  check_members(options);
  chainmail::check(options.softness);
}

Row ramp_row(Algorithm algorithm, const RampPasses& passes, double budget) {
  Row row{.contestant = {algorithm}};
  const auto count = double(passes.ms.size());
  row.set(figures::passes, count);
  bool in_real_time = true;
  if (count > 0) {
    const double slowest = percentile(passes.ms, percentile_kept);
    row.set(figures::median_ms, percentile(passes.ms, 0.5));
    row.set(figures::p99_ms, slowest);
    row.set(figures::mean_moved, double(passes.moved) / count);
    in_real_time = slowest <= 1000 * budget;
  }
  row.set(figures::repeated, 0.0);
  row.set(figures::real_time, in_real_time ? 1.0 : 0.0);
  return row;
}

std::uint64_t ramp_seed(std::uint64_t seed, std::uint32_t width, int attempt) {
  return scattered(seed + scatter_step * (2 * std::uint64_t{width} + static_cast<std::uint64_t>(attempt) - 1));
}

RampRace::RampRace(std::vector<std::uint32_t> widths, std::vector<Algorithm> algorithms, double budget)
    : widths_(std::move(widths)), budget_(budget), in_race_(std::move(algorithms)), attempting_(in_race_) {}

std::vector<Row> RampRace::finish_attempt(std::span<const RampPasses> passes) {
  std::vector<Algorithm> missed;
  for (std::size_t i = 0; i < attempting_.size(); ++i) {
    Row row = ramp_row(attempting_[i], passes[i], budget_);
    row.set(figures::repeated, attempt_ > 0 ? 1.0 : 0.0);
    if (attempt_ == 0 && row[figures::real_time] == 0.0) {
      missed.push_back(attempting_[i]);
    } else {
      rows_.push_back(std::move(row));
    }
  }
  if (!missed.empty()) {
    attempt_ = 1;
    attempting_ = std::move(missed);
    return {};
  }
  for (const Row& row : rows_) {
    if (row[figures::real_time] == 0.0) {
      std::erase(in_race_, *row.contestant.algorithm);
    }
  }
  ++size_;
  attempt_ = 0;
  attempting_ = in_race_;
  std::ranges::sort(rows_, {}, [](const Row& row) { return row.contestant.algorithm; });
  return std::exchange(rows_, {});
}

}  // namespace chainmail::report

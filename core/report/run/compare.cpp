#include "report/run/compare.h"

#include <algorithm>
#include <set>

#include "equilibrium/link_energy.h"
#include "measure/distance.h"
#include "measure/equilibrium.h"
#include "measure/violation.h"
#include "mesh/error.h"
#include "mesh/parameters.h"

namespace chainmail::report {
namespace {

// Above this number of elements, the equilibrium takes longer than all contestants together.
constexpr ElementId equilibrium_limit = 131'072;

double energy_of(const Simulation& simulation) {
  return elastic_energy(simulation.mesh(), simulation.softness(), simulation.body().cuts(),
                        simulation.body().positions(), simulation.elastic());
}

Distance between(const Runner& one, const Runner& other) {
  return measure_distance(one.simulation().mesh(), one.simulation().body().positions(),
                          other.simulation().body().positions());
}

/// Measures the errors of contestants on a drag, against Exact ChainMail in double and against the same contestant in
/// the other precision.
class ExactReferee : public Referee {
 public:
  ExactReferee(const Case& object, const RecordedMoves& moves, const RunOptions& options, const Progress& progress)
      : object_(object), moves_(moves), options_(options), progress_(progress) {
    try {
      exact_ = std::make_unique<Runner>(object, Algorithm::exact, Precision::double_precision, options);
      exact_->run(moves, 0, progress);
      energy_of_exact_ = energy_of(exact_->simulation());
      find_equilibrium();
    } catch (const Error& error) {
      exact_.reset();
      no_exact_ = error.what();
    }
  }

  /// Reason why there is no result of Exact ChainMail for comparison; empty if there is one.
  const std::string& no_exact() const { return no_exact_; }

  void judge(const Runner& runner, const Contestant& contestant, Row& row) override {
    using namespace figures;
    const Simulation& simulation = runner.simulation();
    const Mesh& mesh = simulation.mesh();
    const PositionView positions = simulation.body().positions();
    const Violation violation = measure_violation(simulation.body());
    add_shape(row, mesh, simulation.softness(), simulation.body().cuts(), positions,
              exact_ ? std::optional(exact_->simulation().body().positions()) : std::nullopt);
    row.set(violation_rms, violation.rms);
    row.set(violation_fraction, violation.fraction);
    if (exact_) {
      add(row, exact_distance_max, exact_distance_rms, between(runner, *exact_));
      row.set(energy_over_exact, energy_ratio(energy_of(simulation), energy_of_exact_));
    }
    if (equilibrium_) {
      add(row, equilibrium_distance_max, equilibrium_distance_rms,
          measure_distance(mesh, positions, equilibrium_->positions(mesh)));
    }
    add(row, float_double_max, float_double_rms, float_to_double(runner, contestant));
    row.set(largest_over_handle, chainmail::largest_over_handle(mesh, positions, runner.handle()));
  }

 private:
  static void add(Row& row, const Figure& max, const Figure& rms, const Distance& distance) {
    row.set(max, distance.max);
    row.set(rms, distance.rms);
  }

  Distance float_to_double(const Runner& runner, const Contestant& contestant) {
    const bool in_float = options_.precision == Precision::single_precision;
    if (!other_ || other_->simulation().statistics().algorithm != contestant.algorithm) {
      other_ = std::make_unique<Runner>(object_, *contestant.algorithm,
                                        in_float ? Precision::double_precision : Precision::single_precision, options_);
    }
    other_->run(moves_, {contestant.sweeps, contestant.equilibrium}, progress_);
    return between(runner, *other_);
  }

  /// Finds the end of full relaxation, with the handle and the pins at the positions of Exact ChainMail.
  void find_equilibrium() {
    const Simulation& simulation = exact_->simulation();
    const auto pins = simulation.body().pins();
    std::vector<ElementId> fixed(pins.begin(), pins.end());
    fixed.insert(fixed.end(), exact_->handle().begin(), exact_->handle().end());
    if (simulation.mesh().element_count() > equilibrium_limit) {
      return;
    }
    try {
      equilibrium_ =
          equilibrium(simulation.mesh(), simulation.softness(), simulation.body().cuts(), fixed,
                      simulation.body().positions(), simulation.body().elastic(), cholesky_limit, progress_.quiet());
    } catch (const Cancelled&) {
      return;  // the result is not needed then
    }
    const bool is_reference =
        equilibrium_ && !equilibrium_->binds && std::ranges::count(equilibrium_->defined, false) == 0;
    if (!is_reference) {
      equilibrium_.reset();
    }
  }

  const Case& object_;
  const RecordedMoves& moves_;
  const RunOptions& options_;
  const Progress& progress_;
  std::unique_ptr<Runner> exact_;
  double energy_of_exact_ = 0;
  std::optional<Equilibrium> equilibrium_;  // only if it is a reference for all elements
  std::string no_exact_;
  std::unique_ptr<Runner> other_;  // runs the algorithm of the last contestant in the other precision
};

std::vector<Contestant> family_of(const CompareOptions& options) {
  std::vector<Contestant> all;
  for (const Algorithm algorithm : options.algorithms) {
    if (!info(algorithm).relaxes()) {
      all.push_back({algorithm});
      continue;
    }
    for (const int sweeps : options.sweeps) {
      all.push_back({algorithm, sweeps});
    }
    if (options.equilibrium && takes_part_at_equilibrium(algorithm)) {
      all.push_back({algorithm, 0, true});
    }
  }
  return all;
}

CompareOptions checked(const std::vector<Case>& cases, CompareOptions options) {
  if (options.algorithms.empty()) {
    for (const AlgorithmInfo& one : algorithms()) {
      options.algorithms.push_back(one.algorithm);
    }
  }
  check(options);
  for (const Case& object : cases) {
    std::ranges::for_each(object.drags, [](const RecordedMoves& moves) { check(moves); });
  }
  return options;
}

}  // namespace

void check(const CompareOptions& options) {
  const bool is_empty = options.sweeps.empty() && !options.equilibrium;
  if (is_empty || std::ranges::any_of(options.sweeps, [](int sweeps) { return sweeps < 0; })) {
    throw Error("relax", "there is no number of sweeps, or a number below 0", "use numbers from 0");
  }
  if (!info(options.scheme).sweeps) {
    throw Error("relaxation", "the equilibrium is not a scheme of sweeps",
                "use mean or link, and list the equilibrium next to the numbers of sweeps");
  }
  check(parameters::relax_step, options.relax_step);
  if (options.repetitions && *options.repetitions < 1) {
    throw Error("repetitions", "the number is below 1", "use 1 or more");
  }
}

ObjectInfo info_of(const Case& object) {
  return {.name = object.name,
          .description = object.description,
          .elements = object.mesh->element_count(),
          .links = object.mesh->link_count() - std::set(object.cuts.begin(), object.cuts.end()).size(),
          .pins = object.pins.size()};
}

DragInfo info_of(const RecordedMoves& moves) {
  return {.name = moves.name,
          .description = moves.description,
          .handle = handle_of(moves),
          .moves = count_moves(moves),
          .has_cut = !cuts_of(moves).empty()};
}

std::vector<Setting> settings_of(const RunOptions& options) {
  return {{"relaxation", std::string(info(options.scheme).name)},
          {"relax_step", options.relax_step},
          {"precision", std::string(name(options.precision))}};
}

void add_drag(Results& results, DragInfo drag, std::vector<Row> rows) {
  auto& drags = results.objects.back().drags;
  for (Row& row : rows) {
    row.object = results.objects.size() - 1;
    row.drag = drags.size();
    results.rows.push_back(std::move(row));
  }
  drags.push_back(std::move(drag));
}

Progress part_of(const Progress& whole, double index, double count, const std::string& text) {
  Progress part = whole.part(index / count, (index + 1) / count);
  part.say(text);
  part.show(0);
  return part;
}

Results compare(const std::vector<Case>& cases, const CompareOptions& asked, const Progress& progress,
                const Finished& finished) {
  const CompareOptions options = checked(cases, asked);
  Results results{.kind = ReportKind::compare, .settings = settings_of(options)};
  std::size_t drags = 0, done = 0;
  for (const Case& object : cases) {
    drags += object.drags.size();
  }
  for (const Case& object : cases) {
    results.objects.push_back(info_of(object));
    results.objects.back().reference = "Exact ChainMail in double";
    Contest contest(object, family_of(options), options);
    for (const RecordedMoves& moves : object.drags) {
      const Progress part = part_of(progress, double(done), double(drags), object.name + ", " + moves.name);
      ExactReferee referee(object, moves, options, part);
      std::vector<Row> rows = contest.run(moves, &referee, part);
      if (progress.cancelled()) {
        results.stopped = true;
        return results;
      }
      DragInfo drag = info_of(moves);
      drag.no_reference = referee.no_exact();
      add_drag(results, std::move(drag), std::move(rows));
      ++done;
      if (finished) {
        finished(results);
      }
    }
  }
  progress.say("done");
  progress.show(1);
  return results;
}

}  // namespace chainmail::report

#include "report/run/errors.h"

#include <algorithm>

#include "equilibrium/link_energy.h"
#include "mesh/error.h"

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

}  // namespace

References::References(const Case& object, const RecordedMoves& moves, const CompareOptions& options,
                       const Progress& progress)
    : object_(object), moves_(moves), options_(options), progress_(progress) {
  try {
    exact_ = std::make_unique<Runner>(object, Algorithm::exact, Precision::double_precision, options);
    exact_->try_run(moves, 0, progress);
    energy_of_exact_ = energy_of(exact_->simulation());
    find_equilibrium();
  } catch (const Error& error) {
    exact_.reset();
    no_exact_ = error.what();
  }
}

/// Finds the end of full relaxation, with the handle and the pins at the positions of Exact ChainMail.
void References::find_equilibrium() {
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
      equilibrium_ && !equilibrium_->binds &&
      std::find(equilibrium_->defined.begin(), equilibrium_->defined.end(), false) == equilibrium_->defined.end();
  if (!is_reference) {
    equilibrium_.reset();
  }
}

Errors References::errors_of(const Runner& runner, const Contestant& contestant) {
  const Simulation& simulation = runner.simulation();
  const PositionView positions = simulation.body().positions();
  Errors errors;
  errors.shape = shape_figures(simulation.mesh(), simulation.softness(), simulation.body().cuts(), positions,
                               exact_ ? std::optional(exact_->simulation().body().positions()) : std::nullopt);
  errors.violation = measure_violation(simulation.mesh(), simulation.softness(), simulation.body().cuts(), positions);
  if (exact_) {
    errors.to_exact = between(runner, *exact_);
    errors.energy_over_exact = energy_ratio(energy_of(simulation), energy_of_exact_);
  }
  if (equilibrium_) {
    errors.to_equilibrium = measure_distance(simulation.mesh(), positions, equilibrium_->positions(simulation.mesh()));
  }
  errors.float_to_double = float_to_double(runner, contestant);
  errors.largest_over_handle = largest_over_handle(simulation.mesh(), positions, runner.handle());
  return errors;
}

Distance References::float_to_double(const Runner& runner, const Contestant& contestant) {
  const bool in_float = options_.precision == Precision::single_precision;
  if (!other_ || other_->simulation().statistics().algorithm != contestant.algorithm) {
    other_ = std::make_unique<Runner>(object_, contestant.algorithm,
                                      in_float ? Precision::double_precision : Precision::single_precision, options_);
  }
  other_->try_run(moves_, contestant.relaxing(), progress_);
  return between(runner, *other_);
}

}  // namespace chainmail::report

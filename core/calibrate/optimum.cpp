#include "calibrate/optimum.h"

#include <nlopt.h>

#include <exception>
#include <limits>
#include <memory>

namespace chainmail {
namespace {

/// State of the library's callback. The library is written in C, so no exception may pass through it.
struct Task {
  nlopt_opt optimizer = nullptr;
  const std::function<double(const std::vector<double>&)>& value;
  Optimum best;
  std::exception_ptr thrown;
};

double evaluate(unsigned count, const double* x, double* /*gradient*/, void* data) {
  Task& task = *static_cast<Task*>(data);
  if (task.thrown) {
    return std::numeric_limits<double>::max();
  }
  try {
    const std::vector<double> at(x, x + count);
    const double value = task.value(at);
    if (value < task.best.value) {
      task.best = {at, value};
    }
    return value;
  } catch (...) {
    task.thrown = std::current_exception();
    nlopt_force_stop(task.optimizer);
    return std::numeric_limits<double>::max();
  }
}

}  // namespace

Optimum find_optimum(Search search, const std::vector<double>& low, const std::vector<double>& high,
                     const std::vector<double>& start, int evaluations,
                     const std::function<double(const std::vector<double>&)>& value) {
  constexpr double first_step = 0.1;     // share of the range, for the search near a point
  constexpr double close_enough = 1e-4;  // relative tolerance of the variables
  const auto method = search == Search::everywhere ? NLOPT_GN_DIRECT_L : NLOPT_LN_SBPLX;
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimizer(
      nlopt_create(method, static_cast<unsigned>(start.size())), &nlopt_destroy);
  if (!optimizer) {
    throw std::bad_alloc();
  }
  Task task{optimizer.get(), value, {start, std::numeric_limits<double>::infinity()}, nullptr};
  std::vector<double> steps;
  for (std::size_t i = 0; i < start.size(); ++i) {
    // Steps inward if the start is on its upper bound.
    const double step = first_step * (high[i] - low[i]);
    steps.push_back(start[i] + step > high[i] ? -step : step);
  }
  nlopt_set_lower_bounds(optimizer.get(), low.data());
  nlopt_set_upper_bounds(optimizer.get(), high.data());
  nlopt_set_initial_step(optimizer.get(), steps.data());
  nlopt_set_xtol_abs1(optimizer.get(), close_enough);
  nlopt_set_maxeval(optimizer.get(), evaluations);
  nlopt_set_min_objective(optimizer.get(), &evaluate, &task);
  std::vector<double> x = start;
  double least = 0;
  nlopt_optimize(optimizer.get(), x.data(), &least);
  if (task.thrown) {
    std::rethrow_exception(task.thrown);
  }
  return std::move(task.best);
}

}  // namespace chainmail

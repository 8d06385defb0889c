// The time of a pass: grids in float, as the window runs them, the corner dragged back and forth.

#include <benchmark/benchmark.h>

#include "mesh/generate.h"
#include "solve/solver.h"

namespace chainmail {
namespace {

/// Stiff links: the whole body follows every move.
constexpr LinkSoftness stiff{0.999, 1.001, 0.0005};

void whole_body(benchmark::State& state, Algorithm algorithm) {
  const auto side = std::uint32_t(state.range(0));
  const auto mesh = generate({MeshKind::grid, {side, side, 1}, 1, {}});
  const auto solver = make_solver(mesh, algorithm, Precision::single_precision);
  solver->set_softness({stiff, {}});
  const double far = side;  // beyond what the links give over the whole diagonal
  double at = 0;
  PassCount count;
  for (auto _ : state) {
    at = at == 0 ? far : 0;
    count = solver->move(0, Point(at, at, 0));
  }
  state.counters["moved"] = double(count.moved);
  state.counters["checked"] = double(count.checked);
  state.counters["per_element"] = benchmark::Counter(
      double(mesh->element_count()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(whole_body, natural_queue, Algorithm::natural_queue)
    ->Arg(64)
    ->Arg(256)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_body, generalized, Algorithm::generalized)
    ->Arg(64)
    ->Arg(256)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace chainmail

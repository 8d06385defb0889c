#include "report/run/scripted_drags.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/run/random.h"

namespace chainmail::report {
namespace {

// Mean step of the handle, in widths of the object.
constexpr double mean_step = 0.02;
// Largest random change of the turning rate per move (radians), and the share of the turning rate that is kept.
constexpr double turn = 0.15;
constexpr double turning_kept = 0.8;

ScriptedDrag draw_walk(const Mesh& mesh, double width, int moves, std::mt19937_64& random) {
  ScriptedDrag drag{static_cast<ElementId>(random() % mesh.element_count()), {}};
  Point at = mesh.rest_position(drag.element);
  const double speed = mean_step * width * std::exp2(uniform(random, -1, 1));
  double direction = uniform(random, 0, 2 * std::numbers::pi), turning = 0;
  for (int move = 0; move < moves; ++move) {
    // The speed follows half a sine wave from the first move to the last, with mean 1.
    const double pace = std::numbers::pi / 2 * std::sin(std::numbers::pi * (move + 0.5) / moves);
    turning = turning_kept * turning + uniform(random, -turn, turn);
    direction += turning;
    at[mesh.axes[0]] += speed * pace * std::cos(direction);
    if (mesh.space_dimension > 1) {
      at[mesh.axes[1]] += speed * pace * std::sin(direction);
    }
    drag.targets.push_back(at);
  }
  return drag;
}

}  // namespace

std::vector<ScriptedDrag> scripted_drags(const Mesh& mesh, std::uint64_t seed, int drags, int moves) {
  const auto [low, high] = bounds(mesh);
  const double width = (high - low).maxCoeff();
  std::mt19937_64 random(seed);
  std::vector<ScriptedDrag> result;
  result.reserve(static_cast<std::size_t>(drags));
  for (int i = 0; i < drags; ++i) {
    result.push_back(draw_walk(mesh, width, moves, random));
  }
  return result;
}

}  // namespace chainmail::report

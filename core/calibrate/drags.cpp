#include "calibrate/drags.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <random>

#include "mesh/error.h"
#include "report/run/physics_cases.h"
#include "report/run/random.h"

namespace chainmail {
namespace {

constexpr int moves = 24;                // number of moves of the handle in each drag, as in a comparison
constexpr int draws_per_drag = 4;        // largest average number of attempts per drag
constexpr double kept_from_pins = 0.25;  // share of the distance from the pins to the farthest element

double squared_to_nearest(const Mesh& mesh, const std::vector<ElementId>& pins, ElementId element) {
  double least = std::numeric_limits<double>::infinity();
  for (const ElementId pin : pins) {
    least = std::min(least, (mesh.rest_position(element) - mesh.rest_position(pin)).squaredNorm());
  }
  return least;
}

/// Returns the elements that can be handles: they are not close to the pins and, in a solid, on its surface.
std::vector<ElementId> handles(const Mesh& mesh, const std::vector<ElementId>& pins) {
  const std::vector<ElementId> elements = report::possible_handles(mesh);
  std::vector<double> distances(elements.size());
  std::ranges::transform(elements, distances.begin(), [&](ElementId e) { return squared_to_nearest(mesh, pins, e); });
  const double enough = kept_from_pins * kept_from_pins * *std::ranges::max_element(distances);
  std::vector<ElementId> free;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (distances[i] > 0 && distances[i] >= enough) {
      free.push_back(elements[i]);
    }
  }
  if (free.empty()) {
    throw Error("pins", "every element is pinned, so none can be dragged", "pin fewer");
  }
  return free;
}

/// Returns a random direction of length 1, along the axes that exist, with uniform distribution.
Point random_direction(const Mesh& mesh, std::mt19937_64& random) {
  while (true) {
    Point direction = Point::Zero();
    for (int k = 0; k < mesh.space_dimension; ++k) {
      direction[mesh.axes[k]] = report::uniform(random, -1, 1);
    }
    if (const double length = direction.norm(); length > 0.1 && length <= 1) {
      return direction / length;
    }
  }
}

ReferenceDrag draw(const Mesh& mesh, const std::vector<ElementId>& free, std::mt19937_64& random) {
  const auto [low, high] = bounds(mesh);
  ReferenceDrag drag;
  drag.element = free[random() % free.size()];
  const double distance = report::uniform(random, shortest_drag, farthest_drag) * (high - low).maxCoeff();
  const Point displacement = distance * random_direction(mesh, random), start = mesh.rest_position(drag.element);
  drag.target = start + displacement;
  drag.moves.commands.emplace_back(commands::Grab{drag.element});
  for (int move = 1; move <= moves; ++move) {
    drag.moves.commands.emplace_back(commands::Drag{start + displacement * move / moves});
  }
  return drag;
}

/// Returns `elements` without `others`; all of `elements` if none would be left.
std::vector<ElementId> without(const std::vector<ElementId>& elements, const std::vector<ElementId>& others) {
  std::vector<ElementId> left;
  std::ranges::copy_if(elements, std::back_inserter(left),
                       [&](ElementId e) { return std::ranges::find(others, e) == others.end(); });
  return left.empty() ? elements : left;
}

/// Returns this many drags with their reference solutions.
std::vector<ReferenceDrag> draw(ReferenceSolver& solver, const Mesh& mesh, const std::vector<ElementId>& free,
                                int count, std::mt19937_64& random, const Progress& progress) {
  std::vector<ReferenceDrag> drags;
  std::string last_failure;
  for (int draws = 0; draws < draws_per_drag * count && int(drags.size()) < count; ++draws) {
    ReferenceDrag drag = draw(mesh, free, random);
    const double done = double(drags.size()) / count, next = double(drags.size() + 1) / count;
    try {
      drag.reference = solver.at(drag.element, drag.target, progress.part(done, next));
      drags.push_back(std::move(drag));
    } catch (const Error& error) {
      last_failure = error.problem();
    }
  }
  if (int(drags.size()) < count) {
    throw Error("reference solution", "too many of the drags do not converge: " + last_failure,
                "try another --seed, or a finer mesh");
  }
  return drags;
}

}  // namespace

ReferenceDrags reference_drags(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                               const Progress& progress) {
  std::mt19937_64 random(options.seed);
  const std::vector<ElementId> free = without(handles(*mesh, options.pins), options.not_these);
  const std::vector<double> at_rest(options.pins.size() * static_cast<std::size_t>(mesh->space_dimension), 0.0);
  ElasticOptions elastic = options.elastic;
  elastic.law = options.law;
  ReferenceSolver solver({mesh, cuts, options.pins, at_rest, elastic}, progress.part(0, 0.1));
  const double fitted = 0.1 + 0.9 * options.drags / (options.drags + options.held_out);
  ReferenceDrags drags;
  drags.fitted = draw(solver, *mesh, free, options.drags, random, progress.part(0.1, fitted));
  std::vector<ElementId> seen = options.not_these;
  for (const ReferenceDrag& drag : drags.fitted) {
    seen.push_back(drag.element);
  }
  drags.held_out = draw(solver, *mesh, without(free, seen), options.held_out, random, progress.part(fitted, 1));
  return drags;
}

}  // namespace chainmail

#include "calibrate/drags.h"

#include <algorithm>
#include <random>

#include "mesh/error.h"
#include "mesh/layers.h"
#include "report/random.h"

namespace chainmail {
namespace {

constexpr int moves = 24;                           // of the hand, as in a comparison
constexpr double shortest = 0.05, farthest = 0.20;  // of the object's largest extent
constexpr int draws_a_drag = 4;                     // before it is given up
constexpr double kept_from_pins = 0.25;             // of the way from the pins to the element farthest from them

double squared_to_nearest(const Mesh& mesh, const std::vector<ElementId>& pins, ElementId element) {
  double least = std::numeric_limits<double>::infinity();
  for (const ElementId pin : pins) {
    least = std::min(least, (mesh.rest_position(element) - mesh.rest_position(pin)).squaredNorm());
  }
  return least;
}

/// Who may be in the hand: of a solid what a hand can reach, and nobody right beside the pins.
std::vector<ElementId> hands(const Mesh& mesh, const std::vector<ElementId>& pins) {
  std::vector<ElementId> elements;
  if (mesh.space_dimension == 3) {
    elements = boundary(mesh);
  }
  if (elements.empty()) {
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      elements.push_back(e);
    }
  }
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

/// Of length 1, along the axes that the scene carries, all directions alike.
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

TrueDrag draw(const Mesh& mesh, const std::vector<ElementId>& free, std::mt19937_64& random) {
  const auto [low, high] = bounds(mesh);
  TrueDrag drag;
  drag.element = free[random() % free.size()];
  const double distance = report::uniform(random, shortest, farthest) * (high - low).maxCoeff();
  const Point way = distance * random_direction(mesh, random), start = mesh.rest_position(drag.element);
  drag.target = start + way;
  drag.moves.commands.emplace_back(commands::Grab{drag.element});
  for (int move = 1; move <= moves; ++move) {
    drag.moves.commands.emplace_back(commands::Drag{start + way * move / moves});
  }
  return drag;
}

}  // namespace

std::vector<TrueDrag> true_drags(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                                 const Progress& progress) {
  std::mt19937_64 random(options.seed);
  const std::vector<ElementId> free = hands(*mesh, options.pins);
  const std::vector<double> at_rest(options.pins.size() * static_cast<std::size_t>(mesh->space_dimension), 0.0);
  TruthSolver solver({mesh, cuts, options.pins, at_rest, options.elastic}, progress.part(0, 0.1));
  std::vector<TrueDrag> drags;
  std::string last_failure;
  for (int draws = 0; draws < draws_a_drag * options.drags && int(drags.size()) < options.drags; ++draws) {
    TrueDrag drag = draw(*mesh, free, random);
    const double done = double(drags.size()) / options.drags, next = double(drags.size() + 1) / options.drags;
    try {
      drag.truth = solver.at(drag.element, drag.target, progress.part(0.1 + 0.9 * done, 0.1 + 0.9 * next));
      drags.push_back(std::move(drag));
    } catch (const Error& error) {
      last_failure = error.problem();
    }
  }
  if (int(drags.size()) < options.drags) {
    throw Error("truth", "too many of the drags do not converge: " + last_failure,
                "try another --seed, or a finer mesh");
  }
  return drags;
}

}  // namespace chainmail

#include "report/run/drags.h"

#include <algorithm>
#include <cmath>

#include "report/run/runner.h"

namespace chainmail::report {
namespace {

constexpr int moves_one_way = 24;
// Ratio of two consecutive distances to try. They run from a tenth of a rest length to `farthest_in_sizes` object
// sizes.
constexpr double next_distance = 1.4;
constexpr double farthest_in_sizes = 100;

double size_of(const Mesh& mesh) {
  const auto [low, high] = bounds(mesh);
  return std::max((high - low).norm(), mesh.mean_link_length);
}

/// Returns a direction that is oblique to all axes of the scene.
Point direction_in(const Mesh& mesh) {
  const Point parts(2, 1, 0.5);
  Point direction = Point::Zero();
  for (int k = 0; k < mesh.space_dimension; ++k) {
    direction[mesh.axes[k]] = parts[k];
  }
  return direction.normalized();
}

/// Returns the unpinned element with the smallest `measure`; if there are several, the one with the lowest id.
template <class Measure>
ElementId element_with_smallest(const Case& object, Measure measure) {
  ElementId best = no_element;
  double least = 0;
  for (ElementId e = 0; e < object.mesh->element_count(); ++e) {
    const double value = measure(object.mesh->rest_position(e));
    // This search is last, because few elements get here.
    if ((best == no_element || value < least) && std::ranges::find(object.pins, e) == object.pins.end()) {
      best = e;
      least = value;
    }
  }
  return best == no_element ? 0 : best;
}

/// Pulls one element from rest by different distances, each in one move of Exact ChainMail.
class Trial {
 public:
  Trial(const Case& object, ElementId element, const Progress& progress)
      : simulation_(object.mesh, Algorithm::exact, Precision::double_precision),
        element_(element),
        progress_(progress) {
    set_up(simulation_, object);
    simulation_.apply(commands::Grab{element});
  }

  std::uint64_t moved_by(double distance) {
    const Mesh& mesh = simulation_.mesh();
    simulation_.apply(commands::Reset{});
    simulation_.apply(commands::Drag{mesh.rest_position(element_) + distance * direction_in(mesh)});
    return simulation_.statistics().last_pass.moved;
  }

  /// Returns the shortest of the tried distances at which `wanted` elements follow. If pins or the size of the object
  /// prevent that, returns the shortest at which as many as possible follow.
  double distance_for(std::uint64_t wanted) {
    const Mesh& mesh = simulation_.mesh();
    const double farthest = farthest_in_sizes * size_of(mesh);
    double best = farthest / farthest_in_sizes;
    std::uint64_t most = 0;
    for (double distance = mesh.mean_link_length / 10; distance > 0 && distance < farthest; distance *= next_distance) {
      const std::uint64_t moved = moved_by(distance);
      if (moved > most) {
        most = moved;
        best = distance;
      }
      if (moved >= wanted || progress_.cancelled()) {
        break;
      }
    }
    return best;
  }

 private:
  Simulation simulation_;
  ElementId element_;
  const Progress& progress_;
};

/// Adds moves of equal length, from share `from` to share `to` of the displacement `way`.
void add_moves(RecordedMoves& drag, const Point& start, const Point& way, double from, double to) {
  for (int move = 1; move <= moves_one_way; ++move) {
    drag.commands.emplace_back(commands::Drag{start + std::lerp(from, to, double(move) / moves_one_way) * way});
  }
}

RecordedMoves drag_out(const Mesh& mesh, ElementId element, double distance) {
  RecordedMoves drag;
  drag.commands.emplace_back(commands::Grab{element});
  add_moves(drag, mesh.rest_position(element), distance * direction_in(mesh), 0, 1);
  return drag;
}

std::string named(ElementId element) { return "element " + std::to_string(element); }

}  // namespace

std::vector<RecordedMoves> three_drags(const Case& object, const Progress& progress) {
  const Mesh& mesh = *object.mesh;
  const auto [low, high] = bounds(mesh);
  const Point centre = (low + high) / 2, outward = direction_in(mesh);
  const ElementId middle = element_with_smallest(object, [&](const Point& at) { return (at - centre).squaredNorm(); });
  const ElementId edge = element_with_smallest(object, [&](const Point& at) { return -at.dot(outward); });
  Trial from_middle(object, middle, progress), from_edge(object, edge, progress);
  const std::uint64_t all = mesh.element_count() - 1;

  RecordedMoves local = drag_out(mesh, middle, from_middle.distance_for(std::clamp<std::uint64_t>(all / 8, 12, 300)));
  local.name = "local";
  local.description = named(middle) + ", nearest the middle, until about an eighth of the object follows";
  RecordedMoves whole = drag_out(mesh, edge, 2 * from_edge.distance_for(all));
  whole.name = "whole body";
  whole.description = named(edge) + ", at the edge, outward until all elements follow, and as far again";
  const double reach = from_middle.distance_for(all);
  RecordedMoves back_and_forth = drag_out(mesh, middle, reach);
  add_moves(back_and_forth, mesh.rest_position(middle), reach * outward, 1, 0);
  back_and_forth.name = "back and forth";
  back_and_forth.description = named(middle) + ", nearest the middle, until all elements follow, and back";
  return {std::move(local), std::move(whole), std::move(back_and_forth)};
}

}  // namespace chainmail::report

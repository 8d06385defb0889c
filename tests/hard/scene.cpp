#include "hard/scene.h"

#include <cmath>

#include "report/run/compare.h"

namespace chainmail::hard {
namespace {

double epsilon(Precision precision) { return precision == Precision::single_precision ? 0x1p-23 : 0x1p-52; }
double smallest(Precision precision) { return precision == Precision::single_precision ? 0x1p-149 : 0x1p-1074; }

}  // namespace

std::string label(const Contender& contender) {
  return contender.equilibrium ? contender.energy == EnergyKind::material ? "Exact + material" : "Exact + links"
                               : report::label(report::Contestant{contender.algorithm});
}

Scene::Scene(MeshPointer mesh, const Contender& contender, Precision precision, const Softness& softness)
    : simulation_(std::move(mesh), contender.algorithm, precision), contender_(contender), precision_(precision) {
  set_softness(softness);
}

void Scene::set_softness(Softness softness) {
  softness.energy = contender_.energy;
  simulation_.apply(commands::SetSoftness{softness});
}

void Scene::drag(ElementId element, const Point& target, int steps) {
  const Point start = test::position_of(simulation_, element);
  simulation_.apply(commands::Grab{element});
  for (int step = 1; step <= steps; ++step) {
    for (int k = 0; k < 3; ++k) {
      target_[k] = std::lerp(start[k], target[k], double(step) / steps);
    }
    largest_ = std::max(largest_, (target_ - test::position_of(simulation_, element)).cwiseAbs().maxCoeff());
    simulation_.apply(commands::Drag{target_});
    stopped_ = simulation_.statistics().last_pass.stopped;
  }
  handle_ = element;
}

void Scene::drag_by(ElementId element, const Point& by, int steps) {
  drag(element, test::position_of(simulation_, element) + by, steps);
}

void Scene::pin(const std::vector<ElementId>& elements) {
  simulation_.apply(commands::Release{});
  handle_.reset();
  simulation_.apply(commands::Pin{elements});
  for (const ElementId element : elements) {
    pins_.emplace_back(element, test::position_of(simulation_, element));
  }
}

/// Returns true if an element is within some ulps of a position, on the axes that exist.
bool Scene::is_at(ElementId element, const Point& position, double ulps) const {
  const Mesh& mesh = simulation_.mesh();
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const double there = position[mesh.axes[k]];
    const double rest = mesh.rest[std::size_t{element} * mesh.space_dimension + k];
    const double size = std::max(std::abs(there), std::abs(rest));
    const double rounding = ulps * std::max(epsilon(precision_) * size, smallest(precision_));
    if (!(std::abs(simulation_.body().positions()(element, k) - there) <= rounding)) {
      return false;
    }
  }
  return true;
}

double Scene::shortest_link() const {
  const Mesh& mesh = simulation_.mesh();
  double shortest = mesh.mean_link_length;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const double length = rest_length(mesh, link);
    shortest = length > 0 ? std::min(shortest, length) : shortest;
  }
  return shortest;
}

/// Every iteration must leave a valid state, so that few are enough for a large object.
void Scene::relax() {
  const std::uint32_t iterations = simulation_.mesh().element_count() > 50'000 ? 4 : 100;
  simulation_.apply(commands::Relax{iterations, 1, RelaxationScheme::equilibrium, 1e-3});
}

Outcome Scene::outcome() {
  if (contender_.equilibrium) {
    relax();
  }
  Outcome outcome;
  const auto now = positions();
  for (const double x : now) {
    outcome.finite = outcome.finite && std::isfinite(x);
  }
  outcome.stopped = stopped_;
  outcome.anchors = !handle_ || stopped_ || is_at(*handle_, target_, 1);
  for (const auto& [pin, position] : pins_) {
    outcome.anchors = outcome.anchors && is_at(pin, position, 0);
  }
  simulation_.measure_all();
  outcome.violation = simulation_.statistics().violation;
  // Absolute positions round in proportion to their coordinates, displacements in proportion to their own size.
  const bool absolute = simulation_.statistics().algorithm != Algorithm::exact;
  double size = largest_, coordinate = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    size = std::max(size, std::abs(absolute ? now[i] : now[i] - simulation_.mesh().rest[i]));
    coordinate = std::max(coordinate, std::abs(now[i]));
  }
  // The violation itself is computed from absolute positions in double.
  outcome.rounding = 8 * (epsilon(precision_) * size + 0x1p-52 * coordinate) / shortest_link();
  return outcome;
}

double distance_between(const Mesh& mesh, const std::vector<double>& one, const std::vector<double>& other) {
  double square = 0;
  const int n = mesh.space_dimension;
  for (std::size_t e = 0; e < mesh.element_count(); ++e) {
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      sum += std::pow(one[e * n + k] - other[e * n + k], 2);
    }
    square = std::max(square, sum);
  }
  return std::sqrt(square) / mesh.mean_link_length;
}

}  // namespace chainmail::hard

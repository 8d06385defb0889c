#include "elastic/rigid_fit.h"

#include "elastic/closest_rotation.h"

namespace chainmail {
namespace {

template <int N>
std::vector<double> rigid_fit_in(const ElasticProblem& problem) {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  const std::vector<double>& rest = problem.mesh->rest;
  const auto at = [](const std::vector<double>& all, std::size_t i) {
    return Eigen::Map<const Vector>(all.data() + i * std::size_t(N));
  };
  const auto& pins = problem.pins;
  Vector centre = Vector::Zero(), moved = Vector::Zero();
  for (std::size_t i = 0; i < pins.size(); ++i) {
    centre += at(rest, pins[i]) / double(pins.size());
    moved += at(problem.pinned, i) / double(pins.size());
  }
  Square sum = Square::Zero();
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const Vector arm = at(rest, pins[i]) - centre;
    sum += (arm + at(problem.pinned, i) - moved) * arm.transpose();
  }
  Square rotation = Square::Identity();
  turn_to_closest(sum, rotation);
  const Square turn = rotation - Square::Identity();
  std::vector<double> all(rest.size());
  for (std::size_t e = 0; e < problem.mesh->element_count(); ++e) {
    Eigen::Map<Vector>(all.data() + e * std::size_t(N)) = turn * (at(rest, e) - centre) + moved;
  }
  return all;
}

}  // namespace

std::vector<double> rigid_fit(const ElasticProblem& problem) {
  switch (problem.mesh->space_dimension) {
    case 1:
      return rigid_fit_in<1>(problem);
    case 2:
      return rigid_fit_in<2>(problem);
    default:
      return rigid_fit_in<3>(problem);
  }
}

}  // namespace chainmail

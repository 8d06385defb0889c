#include "elastic/iterated.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "elastic/closest_rotation.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

IteratedSolver::IteratedSolver(const ElasticProblem& problem, const Simplices& cells)
    : problem_(problem), in_cell_(problem.mesh->element_count(), false), base_(problem.mesh->rest.size(), 0.0) {
  for (const ElementId corner : cells.corners) {
    in_cell_[corner] = true;
  }
  displacements_ = base_;
}

void IteratedSolver::find_base(const Progress& progress) {
  if (std::ranges::any_of(problem_.pinned, [](double one) { return one != 0; })) {
    start_from(rigid_fit(problem_));
    base_ = displacements_;
    prescribe(problem_.pins, progress.part(0, 0.2));
    base_remark_ = relax(base_, progress.part(0.2, 1));
  }
  reset();
}

void IteratedSolver::hold(const ElasticHandle& handle, const Progress& progress) {
  if (!holds_ || handle.elements != handle_.elements) {
    holds_ = false;
    std::vector<ElementId> prescribed = problem_.pins;
    prescribed.insert(prescribed.end(), handle.elements.begin(), handle.elements.end());
    prescribe(prescribed, progress);
    holds_ = true;
  }
  handle_ = handle;
}

void IteratedSolver::move(const ElasticMotion& motion, const Progress& progress) {
  const auto n = static_cast<std::size_t>(problem_.mesh->space_dimension);
  std::vector<double> answer = displacements_;
  for (std::size_t i = 0; i < handle_.elements.size(); ++i) {
    const SmallVector displacement = displacement_of(handle_, i, motion);
    std::ranges::copy(displacement, answer.begin() + static_cast<std::ptrdiff_t>(handle_.elements[i] * n));
  }
  std::string remark = relax(answer, progress);
  displacements_ = std::move(answer);
  remark_ = std::move(remark);
}

void IteratedSolver::reset() {
  displacements_ = base_;
  remark_ = base_remark_;
}

void IteratedSolver::start_from(std::span<const double> displacements) {
  const auto n = static_cast<std::size_t>(problem_.mesh->space_dimension);
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    displacements_[i] = in_cell_[i / n] ? displacements[i] : base_[i];
  }
  for (std::size_t i = 0; i < problem_.pinned.size(); ++i) {
    displacements_[problem_.pins[i / n] * n + i % n] = problem_.pinned[i];
  }
}

std::string not_converged(std::uint32_t iterations, double step) {
  std::array<char, 32> size{};
  std::snprintf(size.data(), size.size(), "%.2g", step);
  return "it did not converge in " + std::to_string(iterations) + (iterations == 1 ? " iteration" : " iterations") +
         ": elements still move by up to " + size.data() +
         " of the mean edge length per iteration; this is the last iterate";
}

namespace {

template <int N>
std::vector<double> rigid_fit_in(const ElasticProblem& problem) {
  using Vector = FixedMatrix<double, N>;
  using Square = FixedMatrix<double, N, N>;
  const std::vector<double>& rest = problem.mesh->rest;
  const auto at = [](const std::vector<double>& all, std::size_t i) {
    return Vector::from(all.data() + i * std::size_t(N));
  };
  const auto& pins = problem.pins;
  Vector centre, moved;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    centre += at(rest, pins[i]) / double(pins.size());
    moved += at(problem.pinned, i) / double(pins.size());
  }
  Square sum;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const Vector arm = at(rest, pins[i]) - centre;
    sum += outer_product(arm + at(problem.pinned, i) - moved, arm);
  }
  Square rotation = Square::Identity();
  turn_to_closest(sum, rotation);
  const Square turn = rotation - Square::Identity();
  std::vector<double> all(rest.size());
  for (std::size_t e = 0; e < problem.mesh->element_count(); ++e) {
    std::copy_n((turn * (at(rest, e) - centre) + moved).data(), N, all.data() + e * std::size_t(N));
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

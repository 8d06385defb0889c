#include "measure/principal_stretch.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "measure/element_cells.h"

namespace chainmail {
namespace {

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// Returns the largest principal stretch of a simplex; 0 if it is flat at rest.
double stretch_of(const Mesh& mesh, const Simplex& simplex, const PositionView& positions) {
  const auto rest = simplex.edges([&](ElementId e) { return mesh.rest_position(e); });
  const auto now = simplex.edges([&](ElementId e) { return point_of(mesh, positions, e); });
  // The squares of the stretches are the eigenvalues of the metric now, relative to that at rest.
  const Square before = rest.transpose() * rest, after = now.transpose() * now;
  if (!(before.determinant() > 1e-16 * std::pow(before.trace(), double(before.rows())))) {
    return 0;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Square> solver(after, before, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

}  // namespace

std::optional<double> largest_principal_stretch(const Mesh& mesh, const PositionView& positions) {
  double largest = 0;
  for (const Simplex& one : simplices_of(mesh)) {
    largest = std::max(largest, stretch_of(mesh, one, positions));
  }
  return largest > 0 ? std::optional(largest) : std::nullopt;
}

}  // namespace chainmail

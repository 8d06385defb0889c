#pragma once

#include <Eigen/Core>
#include <memory>

#include "elastic/elastic.h"
#include "elastic/energy.h"

namespace chainmail {

/// The time step of XPBD. It decides on how fast the object follows, and a little on where it comes to rest.
struct XpbdStep {
  /// The square of the time step, times the stiffness of the mean spring, over the mass of an element. The answer at
  /// rest differs from the least energy in proportion to this, because one iteration does not meet all constraints.
  double springs_over_inertia = 2;
  double damping = 0.02;  // share of its velocity that an element loses in a time step
};

/// Makes a solver with another time step than the usual one.
std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const XpbdStep& step, const Progress& progress);

/// The values of which the two constraints of a simplex consist, with their derivatives by its corners, one per column.
template <int N>
struct NeoHookeanConstraints {
  using Square = Eigen::Matrix<double, N, N>;
  using Corners = Eigen::Matrix<double, N, N + 1>;

  /// `edges`: from corner 0 to the others. `gradients`: of the shape functions of these others at rest (1 / mesh unit).
  NeoHookeanConstraints(const Square& edges, const Square& gradients) {
    const Square f = edges * gradients.transpose();
    const Square cofactor = cofactors(f);
    shape = f.squaredNorm();
    volume = f.col(0).dot(cofactor.col(0));
    by_shape.template rightCols<N>().noalias() = f * gradients;
    by_volume.template rightCols<N>().noalias() = cofactor * gradients;
    by_shape.col(0) = -by_shape.template rightCols<N>().rowwise().sum();
    by_volume.col(0) = -by_volume.template rightCols<N>().rowwise().sum();
  }

  double shape;                 // tr FᵀF
  double volume;                // det F
  Corners by_shape, by_volume;  // of shape / 2 and of volume
};

/// Makes a solver with another time step than the usual one.
std::unique_ptr<ElasticSolver> make_neo_hookean_xpbd(const ElasticProblem& problem, const XpbdStep& step,
                                                     const Progress& progress);

}  // namespace chainmail

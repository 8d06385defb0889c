#pragma once

#include <memory>

#include "elastic/elastic.h"
#include "mesh/fixed_matrix.h"

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
  using Square = FixedMatrix<double, N, N>;
  using Corners = FixedMatrix<double, N, N + 1>;

  /// `edges`: from corner 0 to the others. `gradients`: of the shape functions of these others at rest (1 / mesh unit).
  /// As a call, it makes XPBD 15 % slower.
  [[gnu::always_inline]] NeoHookeanConstraints(const Square& edges, const Square& gradients) {
    const Square f = edges * transposed(gradients), adjoint = adjugate(f);
    shape = f.squaredNorm();
    volume = determinant(f, adjoint);
    const Square shapes = f * gradients, volumes = transposed(adjoint) * gradients;
    for (int k = 0; k < N; ++k) {
      for (int i = 0; i < N; ++i) {
        by_shape(i, k + 1) = shapes(i, k);
        by_shape(i, 0) -= shapes(i, k);
        by_volume(i, k + 1) = volumes(i, k);
        by_volume(i, 0) -= volumes(i, k);
      }
    }
  }

  double shape;                 // tr FᵀF
  double volume;                // det F
  Corners by_shape, by_volume;  // of shape / 2 and of volume
};

/// Makes a solver with another time step than the usual one.
std::unique_ptr<ElasticSolver> make_neo_hookean_xpbd(const ElasticProblem& problem, const XpbdStep& step,
                                                     const Progress& progress);

}  // namespace chainmail

#include "elastic/energy.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "elastic/stiffening.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {
namespace {

template <int N>
SimplexEnergy energy_in(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                        const StrainLaw& law, const Lame& lame, Want want) {
  using Square = FixedMatrix<double, N, N>;
  using Corners = FixedMatrix<double, N, N + 1>;
  const Corners rest = Corners::from(simplices.gradients_of(simplex).data());
  const double volume = simplices.volumes[simplex];
  const Square strain = Corners::from(at.data()) * transposed(rest);  // F − 1
  const Square deformation = Square::Identity() + strain, adjoint = adjugate(deformation);
  SimplexEnergy result;
  const double ratio = determinant(deformation, adjoint);
  result.inverted = !(ratio > 0);
  if (result.inverted) {
    return result;
  }
  // Written in terms of F − 1, tr FᵀF − n keeps its digits for a small deformation.
  const StiffeningTerm term = stiffening_term(2 * strain.trace() + strain.squaredNorm(), std::log(ratio), law, lame, N);
  result.inverted = term.infinite;
  if (result.inverted) {
    return result;
  }
  result.energy = volume * term.value;
  result.magnitude = volume * term.magnitude;
  if (want == Want::energy) {
    return result;
  }
  const Corners by_volume = transposed(adjoint) / ratio * rest;  // derivatives of L
  const Corners by_shape = 2 * (deformation * rest);             // of S
  const Corners forces = volume * (term.slope_s * by_shape + term.slope_l * by_volume);
  result.gradient = Eigen::Map<const CornerVector>(forces.data(), Corners::size);
  if (want == Want::gradient) {
    return result;
  }
  result.hessian.resize(Corners::size, Corners::size);
  const FixedMatrix<double, N + 1, N + 1> products = transposed(rest) * rest;
  for (int q = 0; q < Corners::size; ++q) {
    for (int p = 0; p < Corners::size; ++p) {
      const int a = p / N, i = p % N, b = q / N, j = q % N;  // corner and axis
      result.hessian(p, q) =
          volume *
          (term.curvature_ss * by_shape[p] * by_shape[q] + term.curvature_ll * by_volume[p] * by_volume[q] +
           term.curvature_sl * (by_shape[p] * by_volume[q] + by_volume[p] * by_shape[q]) -
           term.slope_l * by_volume(i, b) * by_volume(j, a) + (i == j ? 2 * term.slope_s * products(a, b) : 0));
    }
  }
  if (want == Want::convex) {
    result.hessian = convex_part(result.hessian);
  }
  return result;
}

}  // namespace

CornerMatrix convex_part(const CornerMatrix& hessian) {
  const Eigen::SelfAdjointEigenSolver<CornerMatrix> modes(hessian);
  const CornerMatrix& vectors = modes.eigenvectors();
  return vectors * modes.eigenvalues().cwiseMax(0).asDiagonal() * vectors.transpose();
}

SimplexEnergy energy_of_law(const Simplices& simplices, std::size_t simplex, const CornerDisplacements& at,
                            const StrainLaw& law, const Lame& lame, Want want) {
  switch (simplices.dimension) {
    case 1:
      return energy_in<1>(simplices, simplex, at, law, lame, want);
    case 2:
      return energy_in<2>(simplices, simplex, at, law, lame, want);
    default:
      return energy_in<3>(simplices, simplex, at, law, lame, want);
  }
}

CornerMatrix stiffness(const Simplices& simplices, std::size_t simplex, const Lame& lame) {
  const CornerDisplacements rest = CornerDisplacements::Zero(simplices.dimension, simplices.dimension + 1);
  return energy_of_law(simplices, simplex, rest, {}, lame, Want::hessian).hessian;
}

}  // namespace chainmail

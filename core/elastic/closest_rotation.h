#pragma once

#include <cmath>

#include "mesh/fixed_matrix.h"

namespace chainmail {

// The rotation R closest to a matrix A: it maximises tr RᵀA over all rotations. For a positive determinant, it is the
// rotation of the polar decomposition. For a negative one, it is that of the decomposition in which the smallest
// singular value is negative (Irving, Teran and Fedkiw 2004), so inverted cells turn back on the shortest way. R enters
// as the start of the search: the nearer, the faster.

inline void turn_to_closest(const FixedMatrix<double, 1, 1>& /*matrix*/, FixedMatrix<double, 1, 1>& rotation) {
  rotation[0] = 1;
}

inline void turn_to_closest(const FixedMatrix<double, 2, 2>& matrix, FixedMatrix<double, 2, 2>& rotation) {
  const double cosine = matrix(0, 0) + matrix(1, 1), sine = matrix(1, 0) - matrix(0, 1);
  const double size = std::sqrt(cosine * cosine + sine * sine);
  if (size > 0) {
    rotation(0, 0) = rotation(1, 1) = cosine / size;
    rotation(1, 0) = sine / size;
    rotation(0, 1) = -rotation(1, 0);
  }
}

/// In space, by Newton's method for the angles. All maxima of tr RᵀA have the same value, so a stationary point with
/// negative curvature is the answer. Where Newton finds none in a few steps, an eigenvector decides.
void turn_to_closest(const FixedMatrix<double, 3, 3>& matrix, FixedMatrix<double, 3, 3>& rotation);

}  // namespace chainmail

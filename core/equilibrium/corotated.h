#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "mesh/fixed_matrix.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Turns a rotation to the one R closest to a matrix, which minimises Σ |d − R r|² if the matrix is Σ d rᵀ: the
/// rotation in its polar decomposition. On a line it is 1.
inline void turn_toward(const FixedMatrix<double, 1, 1>& /*sum*/, FixedMatrix<double, 1, 1>& rotation) {
  rotation[0] = 1;
}

inline void turn_toward(const FixedMatrix<double, 2, 2>& sum, FixedMatrix<double, 2, 2>& rotation) {
  const double cosine = sum(0, 0) + sum(1, 1), sine = sum(1, 0) - sum(0, 1),
               size = std::sqrt(cosine * cosine + sine * sine);
  if (size > 0) {
    rotation(0, 0) = rotation(1, 1) = cosine / size;
    rotation(1, 0) = sine / size;
    rotation(0, 1) = -sine / size;
  }
}

/// Returns the rotation of the quaternion 1 + i x/2 + j y/2 + k z/2: a turn by a small angle (x, y, z), but for the
/// third order.
inline FixedMatrix<double, 3, 3> rotation_by(const FixedMatrix<double, 3>& turn) {
  const double x = turn[0] / 2, y = turn[1] / 2, z = turn[2] / 2, twice = 2 / (1 + x * x + y * y + z * z);
  FixedMatrix<double, 3, 3> rotation;
  rotation(0, 0) = 1 - twice * (y * y + z * z);
  rotation(1, 1) = 1 - twice * (x * x + z * z);
  rotation(2, 2) = 1 - twice * (x * x + y * y);
  rotation(0, 1) = twice * (x * y - z);
  rotation(1, 0) = twice * (x * y + z);
  rotation(0, 2) = twice * (x * z + y);
  rotation(2, 0) = twice * (x * z - y);
  rotation(1, 2) = twice * (y * z - x);
  rotation(2, 1) = twice * (y * z + x);
  return rotation;
}

/// In space, by Newton's method from the present rotation on. Far from the answer, it takes the step of
/// Müller, Bender, Chentanez and Macklin (2016), which always turns toward the answer.
inline void turn_toward(const FixedMatrix<double, 3, 3>& sum, FixedMatrix<double, 3, 3>& rotation) {
  constexpr int max_steps = 50;
  constexpr double enough = 1e-7;  // radians; the error after a step of Newton's method is the square of the step
  for (int i = 0; i < max_steps; ++i) {
    const FixedMatrix<double, 3, 3> product = sum * transposed(rotation);
    FixedMatrix<double, 3> torque;
    for (int k = 0; k < 3; ++k) {
      torque[k] = product((k + 2) % 3, (k + 1) % 3) - product((k + 1) % 3, (k + 2) % 3);
    }
    const double trace = product.trace();
    const FixedMatrix<double, 3, 3> curvature =
        trace * FixedMatrix<double, 3, 3>::Identity() - (product + transposed(product)) / 2;
    const FixedMatrix<double, 3, 3> adjoint = adjugate(curvature);
    const double size = determinant(curvature, adjoint);
    const bool is_convex = curvature(0, 0) > 0 && adjoint(2, 2) > 0 && size > 0;
    FixedMatrix<double, 3> turn;
    if (is_convex) {
      turn = adjoint * torque / size;
    }
    if (!is_convex || !(turn.squaredNorm() < 1)) {
      turn = trace != 0 ? torque / std::abs(trace) : FixedMatrix<double, 3>();
    }
    rotation = rotation_by(turn) * rotation;
    if (turn.squaredNorm() < enough * enough) {
      return;
    }
  }
}

/// The corotated energy of links: springs of the links' rest lengths, and a lateral part in the turned frame of each
/// element's neighbourhood. With the vector d of a link, its rest vector r, its axial stiffness a and its lateral
/// stiffness c, it is
///
///     min over rotations R_i of  ½ Σ over links  a (|d| − |r|)² + c/2 (|d − R_i r|² + |d − R_j r|²)
///
/// The lateral part is that of as-rigid-as-possible surfaces (Sorkine and Alexa 2007). A rotation of the object does
/// not change the energy. For small strains and no rotation it is the axial energy without its resistance to rotation.
template <int Dimension>
class CorotatedEnergy {
 public:
  using Vector = FixedMatrix<double, Dimension>;
  using Square = FixedMatrix<double, Dimension, Dimension>;
  using Vectors = std::vector<Vector>;

  /// Forgets the rotations, for another state of the object.
  void reset() { rotations_.clear(); }
  /// Holds the frames of these elements as they are at rest, instead of turning them with their surroundings.
  void hold_frames(std::vector<ElementId> elements) { held_ = std::move(elements); }

  /// Stiffness of a link; 0 for a cut one.
  struct Link {
    double axial = 0, lateral = 0;
  };

  /// Returns the energy at these displacements from rest, and writes its negative gradient, if given. `link_of` gives
  /// the Link of a LinkId. The search for the rotations starts from those of the last call.
  template <class LinkOf>
  double evaluate(const Mesh& mesh, LinkOf link_of, const Vectors& displacements, Vectors* force) {
    find_rotations(mesh, link_of, displacements);
    if (force != nullptr) {
      force->assign(displacements.size(), {});
    }
    double energy = 0;
    for (LinkId l = 0; l < mesh.link_count(); ++l) {
      const Link link = link_of(l);
      const auto [i, j] = mesh.links[l];
      const Vector rest = rest_vector(mesh, i, j), apart = rest + (displacements[j] - displacements[i]);
      const double length = apart.norm(), longer = length - rest.norm();
      const Vector off_i = apart - rotations_[i] * rest, off_j = apart - rotations_[j] * rest;
      energy += link.axial * longer * longer + link.lateral / 2 * (off_i.squaredNorm() + off_j.squaredNorm());
      if (force != nullptr) {
        Vector pull = link.lateral / 2 * (off_i + off_j);
        if (length > 0) {
          pull += link.axial * longer / length * apart;
        }
        (*force)[i] += pull;
        (*force)[j] -= pull;
      }
    }
    return energy / 2;
  }

  static Vector rest_vector(const Mesh& mesh, ElementId from, ElementId to) {
    Vector r;
    for (int k = 0; k < Dimension; ++k) {
      r[k] = mesh.rest[std::size_t{to} * Dimension + std::size_t(k)] -
             mesh.rest[std::size_t{from} * Dimension + std::size_t(k)];
    }
    return r;
  }

 private:
  template <class LinkOf>
  void find_rotations(const Mesh& mesh, LinkOf link_of, const Vectors& displacements) {
    if (rotations_.size() != displacements.size()) {
      rotations_.assign(displacements.size(), Square::Identity());
    }
    if constexpr (Dimension > 1) {
      sums_.assign(displacements.size(), {});
      for (LinkId l = 0; l < mesh.link_count(); ++l) {
        const auto [i, j] = mesh.links[l];
        const Vector rest = rest_vector(mesh, i, j), apart = rest + (displacements[j] - displacements[i]);
        const Square product = outer_product(link_of(l).lateral * apart, rest);
        sums_[i] += product;
        sums_[j] += product;
      }
      for (std::size_t e = 0; e < sums_.size(); ++e) {
        turn_toward(sums_[e], rotations_[e]);
      }
      for (const ElementId element : held_) {
        rotations_[element] = Square::Identity();
      }
    }
  }

  std::vector<Square> rotations_;  // of each element's neighbourhood
  std::vector<ElementId> held_;    // elements whose frames stay
  std::vector<Square> sums_;       // Σ c d rᵀ over the links of each element
};

}  // namespace chainmail

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "equilibrium/link_matrix.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Turns a rotation to the one R closest to a matrix, which minimises Σ |d − R r|² if the matrix is Σ d rᵀ: the
/// rotation in its polar decomposition. On a line it is 1.
inline void turn_toward(const Eigen::Matrix<double, 1, 1>& /*sum*/, Eigen::Matrix<double, 1, 1>& rotation) {
  rotation.setOnes();
}

inline void turn_toward(const Eigen::Matrix2d& sum, Eigen::Matrix2d& rotation) {
  const double cosine = sum(0, 0) + sum(1, 1), sine = sum(1, 0) - sum(0, 1),
               size = std::sqrt(cosine * cosine + sine * sine);
  if (size > 0) {
    rotation << cosine / size, -sine / size, sine / size, cosine / size;
  }
}

/// Solves a symmetric system by Cramer's rule. Returns false if the matrix is not positive definite.
inline bool solve_positive(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right, Eigen::Vector3d& solution) {
  Eigen::Matrix3d adjugate;
  adjugate.col(0) = matrix.col(1).cross(matrix.col(2));
  adjugate.col(1) = matrix.col(2).cross(matrix.col(0));
  adjugate.col(2) = matrix.col(0).cross(matrix.col(1));
  const double determinant = matrix.col(0).dot(adjugate.col(0));
  if (!(matrix(0, 0) > 0 && adjugate(2, 2) > 0 && determinant > 0)) {
    return false;
  }
  solution = adjugate * right / determinant;
  return true;
}

/// In space, by Newton's method from the present rotation on. Far from the answer, it takes the step of
/// Müller, Bender, Chentanez and Macklin (2016), which always turns toward the answer.
inline void turn_toward(const Eigen::Matrix3d& sum, Eigen::Matrix3d& rotation) {
  constexpr int max_steps = 50;
  constexpr double enough = 1e-7;  // radians; the error after a step of Newton's method is the square of the step
  for (int i = 0; i < max_steps; ++i) {
    const Eigen::Matrix3d product = sum * rotation.transpose();
    const Eigen::Vector3d torque(product(2, 1) - product(1, 2), product(0, 2) - product(2, 0),
                                 product(1, 0) - product(0, 1));
    const double trace = product.trace();
    const Eigen::Matrix3d curvature = trace * Eigen::Matrix3d::Identity() - (product + product.transpose()) / 2;
    Eigen::Vector3d turn;
    if (!solve_positive(curvature, torque, turn) || !(turn.squaredNorm() < 1)) {
      turn = trace != 0 ? Eigen::Vector3d(torque / std::abs(trace)) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    }
    // Differs from a turn by this angle in the third order only.
    rotation = Eigen::Quaterniond(1, turn[0] / 2, turn[1] / 2, turn[2] / 2).normalized().toRotationMatrix() * rotation;
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
  using Vector = Eigen::Matrix<double, Dimension, 1>;
  using Square = Eigen::Matrix<double, Dimension, Dimension>;
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
      force->assign(displacements.size(), Vector::Zero());
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
      sums_.assign(displacements.size(), Square::Zero());
      for (LinkId l = 0; l < mesh.link_count(); ++l) {
        const auto [i, j] = mesh.links[l];
        const Vector rest = rest_vector(mesh, i, j), apart = rest + (displacements[j] - displacements[i]);
        const Square product = link_of(l).lateral * apart * rest.transpose();
        sums_[i] += product;
        sums_[j] += product;
      }
      for (std::size_t e = 0; e < sums_.size(); ++e) {
        turn_toward(sums_[e], rotations_[e]);
      }
      for (const ElementId element : held_) {
        rotations_[element].setIdentity();
      }
    }
  }

  std::vector<Square> rotations_;  // of each element's neighbourhood
  std::vector<ElementId> held_;    // elements whose frames stay
  std::vector<Square> sums_;       // Σ c d rᵀ over the links of each element
};

}  // namespace chainmail

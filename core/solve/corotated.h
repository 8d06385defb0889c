#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "solve/link_matrix.h"

namespace chainmail {

/// Turns a rotation to the one R closest to a matrix, which minimises Σ |d − R r|² if the matrix is Σ d rᵀ: the
/// rotation in its polar decomposition. On a line it is 1.
inline void turn_toward(const Eigen::Matrix<double, 1, 1>& /*sum*/, Eigen::Matrix<double, 1, 1>& rotation) {
  rotation.setOnes();
}

inline void turn_toward(const Eigen::Matrix2d& sum, Eigen::Matrix2d& rotation) {
  const double cosine = sum(0, 0) + sum(1, 1), sine = sum(1, 0) - sum(0, 1), size = std::hypot(cosine, sine);
  if (size > 0) {
    rotation << cosine / size, -sine / size, sine / size, cosine / size;
  }
}

/// In space, by steps from the present rotation on (Müller, Bender, Chentanez and Macklin 2016).
inline void turn_toward(const Eigen::Matrix3d& sum, Eigen::Matrix3d& rotation) {
  constexpr int most_steps = 50;
  constexpr double enough = 1e-10;
  for (int i = 0; i < most_steps; ++i) {
    const Eigen::Vector3d torque =
        rotation.col(0).cross(sum.col(0)) + rotation.col(1).cross(sum.col(1)) + rotation.col(2).cross(sum.col(2));
    const double stiffness = std::abs(rotation.cwiseProduct(sum).sum());
    const double angle = stiffness > 0 ? torque.norm() / stiffness : 0;
    if (angle < enough) {
      return;
    }
    rotation = Eigen::AngleAxisd(angle, torque.normalized()).toRotationMatrix() * rotation;
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
    }
  }

  std::vector<Square> rotations_;  // of each element's neighbourhood
  std::vector<Square> sums_;       // Σ c d rᵀ over the links of each element
};

}  // namespace chainmail

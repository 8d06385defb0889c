#include "solve/link_energy.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "solve/corotated.h"

namespace chainmail {
namespace {

/// Returns length^p, limited so that no energy becomes infinite.
double power_of(double length, double p) {
  constexpr double largest = 1e100;
  const double power = p == 0 ? 1 : p == -1 ? 1 / length : std::pow(length, p);
  return std::clamp(power, 1 / largest, largest);
}

Eigen::Vector3d rest_vector(const Mesh& mesh, ElementId from, ElementId to) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int k = 0; k < mesh.space_dimension; ++k) {
    vector[k] =
        mesh.rest[std::size_t{to} * mesh.space_dimension + k] - mesh.rest[std::size_t{from} * mesh.space_dimension + k];
  }
  return vector;
}

Eigen::Vector3d vector_between(const Mesh& mesh, const PositionView& position, ElementId from, ElementId to) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int k = 0; k < mesh.space_dimension; ++k) {
    vector[k] = position.between(from, to, k);
  }
  return vector;
}

/// Returns the rotation closest to a matrix of the plane.
LocalRotation closest_in_plane(const Eigen::Matrix3d& sum) {
  const double cosine = sum(0, 0) + sum(1, 1), sine = sum(1, 0) - sum(0, 1);
  const double size = std::hypot(cosine, sine);
  LocalRotation rotation = LocalRotation::Identity();
  if (size > 0) {
    rotation.topLeftCorner<2, 2>() << cosine / size, -sine / size, sine / size, cosine / size;
  }
  return rotation;
}

/// Returns the rotation closest to a matrix of space. A reflection is avoided along the axis that matters least.
LocalRotation closest_in_space(const Eigen::Matrix3d& sum) {
  if (sum.isZero(0)) {
    return LocalRotation::Identity();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d left = parts.matrixU();
  if ((left * parts.matrixV().transpose()).determinant() < 0) {
    left.col(2) = -left.col(2);
  }
  return left * parts.matrixV().transpose();
}

template <int Dimension>
double corotated_energy_in(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position) {
  std::vector<Eigen::Matrix<double, Dimension, 1>> displacements(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    for (int k = 0; k < Dimension; ++k) {
      displacements[e][k] = position(e, k) - mesh.rest[std::size_t{e} * Dimension + std::size_t(k)];
    }
  }
  const auto link_of = [&](LinkId link) {
    const LinkWeights weights = cuts.is_cut(link) ? LinkWeights() : link_weights(mesh, softness, link);
    return typename CorotatedEnergy<Dimension>::Link{weights.axial, weights.lateral};
  };
  return CorotatedEnergy<Dimension>().evaluate(mesh, link_of, displacements, nullptr);
}

}  // namespace

LinkWeights link_weights(const Mesh& mesh, EnergyKind kind, const LinkSoftness& softness, double rest_length) {
  if (kind == EnergyKind::isotropic) {
    return {0, 1};
  }
  const double mean = mesh.mean_link_length > 0 ? mesh.mean_link_length : 1;
  const double stiffness = softness.stiffness * power_of(rest_length > 0 ? rest_length : mean, softness.exponent);
  return {rest_length > 0 ? stiffness : 0, stiffness * softness.lateral};
}

LinkWeights link_weights(const Mesh& mesh, const Softness& softness, LinkId link) {
  LinkWeights weights = link_weights(mesh, softness.energy, softness.of(link), rest_length(mesh, link));
  if (const auto& shares = mesh.shares.of(mesh); !shares.empty() && softness.energy != EnergyKind::isotropic) {
    weights.axial *= double(shares[link]);
    weights.lateral *= double(shares[link]);
  }
  return weights;
}

LocalRotation local_rotation(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                             ElementId element) {
  if (mesh.space_dimension == 1) {
    return LocalRotation::Identity();
  }
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for_each_neighbour(mesh, cuts, element, [&](ElementId neighbour, EntryId entry) {
    const double axial = link_weights(mesh, softness, mesh.entry_link[entry]).axial;
    sum +=
        axial * vector_between(mesh, position, element, neighbour) * rest_vector(mesh, element, neighbour).transpose();
  });
  return mesh.space_dimension == 2 ? closest_in_plane(sum) : closest_in_space(sum);
}

Eigen::Vector3d turned_rest_vector(const Mesh& mesh, LinkId link, const LocalRotation& a, const LocalRotation& b) {
  return (a + b) / 2 * rest_vector(mesh, mesh.links[link][0], mesh.links[link][1]);
}

double corotated_energy(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position) {
  switch (mesh.space_dimension) {
    case 1:
      return corotated_energy_in<1>(mesh, softness, cuts, position);
    case 2:
      return corotated_energy_in<2>(mesh, softness, cuts, position);
    default:
      return corotated_energy_in<3>(mesh, softness, cuts, position);
  }
}

}  // namespace chainmail

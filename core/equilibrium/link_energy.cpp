#include "equilibrium/link_energy.h"

#include <algorithm>
#include <cmath>

#include "elastic/surface_cells.h"
#include "equilibrium/block_vectors.h"
#include "equilibrium/corotated.h"
#include "equilibrium/material_energy.h"

namespace chainmail {
namespace {

/// Returns length^p, limited so that no energy becomes infinite.
double power_of(double length, double p) {
  constexpr double largest = 1e100;
  const double power = p == 0 ? 1 : p == -1 ? 1 / length : std::pow(length, p);
  return std::clamp(power, 1 / largest, largest);
}

template <int Dimension>
double corotated_energy_in(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position) {
  BlockVectors<double, Dimension> displacements(mesh.element_count());
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

/// It does not change under rotations of the object.
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

double isotropic_energy(const Mesh& mesh, const Cuts& cuts, const PositionView& position) {
  double sum = 0;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    if (cuts.is_cut(link)) {
      continue;
    }
    const auto [a, b] = mesh.links[link];
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const double rest =
          mesh.rest[std::size_t{b} * mesh.space_dimension + k] - mesh.rest[std::size_t{a} * mesh.space_dimension + k];
      const double difference = position.between(a, b, k) - rest;
      sum += difference * difference;
    }
  }
  return sum / 2;
}

double axial_energy(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position) {
  double sum = 0;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    if (cuts.is_cut(link)) {
      continue;
    }
    const auto [a, b] = mesh.links[link];
    const double length = rest_length(mesh, link);
    double along = 0, square = 0;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const double rest =
          mesh.rest[std::size_t{b} * mesh.space_dimension + k] - mesh.rest[std::size_t{a} * mesh.space_dimension + k];
      const double difference = position.between(a, b, k) - rest;
      along += length > 0 ? rest / length * difference : 0;
      square += difference * difference;
    }
    const auto [axial, lateral] = link_weights(mesh, softness, link);
    sum += axial * along * along + lateral * square;
  }
  return sum / 2;
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

EnergyKind energy_in(const Mesh& mesh, EnergyKind kind) { return has_material(mesh) ? kind : energy_of_links(kind); }

double elastic_energy(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                      const ElasticOptions& elastic) {
  switch (energy_in(mesh, softness.energy)) {
    case EnergyKind::isotropic:
      return isotropic_energy(mesh, cuts, position);
    case EnergyKind::axial:
      return axial_energy(mesh, softness, cuts, position);
    case EnergyKind::material:
      return material_energy(mesh, elastic, cuts, position);
    default:
      return corotated_energy(mesh, softness, cuts, position);
  }
}

}  // namespace chainmail

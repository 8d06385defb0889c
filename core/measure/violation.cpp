#include "measure/violation.h"

#include <algorithm>
#include <cmath>

#include "body/region.h"
#include "equilibrium/link_energy.h"
#include "equilibrium/material_energy.h"

namespace chainmail {
namespace {

template <int Dimension>
double excess(const Mesh& mesh, const LinkSoftness& softness, const RegionAxes& axes, const PositionView& position,
              ElementId a, ElementId b) {
  const auto region = valid_region<double, Dimension>(mesh, axes, a, b, softness);
  double vector[Dimension];
  for (int k = 0; k < Dimension; ++k) {
    vector[k] = position.between(a, b, k);
  }
  if (axes.is_turned()) {
    turn_into_axes(mesh, axes, vector);
  }
  double square = 0;
  for (int k = 0; k < Dimension; ++k) {
    const double outside = std::max({region.low[k] - vector[k], vector[k] - region.high[k], 0.0});
    square += outside * outside;
  }
  return std::sqrt(square);
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

double link_violation(const Mesh& mesh, const Softness& softness, const PositionView& position, LinkId link) {
  const auto [a, b] = mesh.links[link];
  const LinkSoftness& of_link = softness.of(link);
  const RegionAxes& axes = softness.axes;
  const double outside = mesh.space_dimension == 1   ? excess<1>(mesh, of_link, axes, position, a, b)
                         : mesh.space_dimension == 2 ? excess<2>(mesh, of_link, axes, position, a, b)
                                                     : excess<3>(mesh, of_link, axes, position, a, b);
  if (outside == 0) {
    return 0;
  }
  const double length = rest_length(mesh, link);
  return outside / (length > 0 ? length : mesh.mean_link_length > 0 ? mesh.mean_link_length : 1);
}

void ViolationSum::add(double violation) {
  ++links_;
  max_ = std::max(max_, violation);
  squares_ += violation * violation;
  violated_ += violation > counts_as_violated ? 1 : 0;
}

Violation ViolationSum::result() const {
  if (links_ == 0) {
    return {};
  }
  return {max_, std::sqrt(squares_ / double(links_)), double(violated_) / double(links_), links_};
}

bool WholeViolation::go_on(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                           LinkId count) {
  const LinkId end = next_ + std::min(count, mesh.link_count() - next_);
  for (; next_ < end; ++next_) {
    if (!cuts.is_cut(next_)) {
      sum_.add(link_violation(mesh, softness, position, next_));
    }
  }
  return end < mesh.link_count();
}

Violation measure_violation(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                            const PositionView& position) {
  WholeViolation whole;
  whole.go_on(mesh, softness, cuts, position, mesh.link_count());
  return whole.result();
}

template <class Use>
void TouchedViolation::for_each_sampled(std::initializer_list<std::span<const ElementId>> elements, std::size_t nth,
                                        Use use) {
  for (const auto& some : elements) {
    for (std::size_t i = 0; i < some.size(); i += nth) {
      use(some[i]);
    }
  }
}

Violation TouchedViolation::measure(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                    const PositionView& position,
                                    std::initializer_list<std::span<const ElementId>> elements, std::size_t most) {
  std::size_t count = 0;
  for (const auto& some : elements) {
    count += some.size();
  }
  const std::size_t nth = count / most + (count % most == 0 ? 0 : 1);
  sampled_ = nth > 1;
  ViolationSum sum;
  seen_.resize(mesh.element_count());
  for_each_sampled(elements, nth, [&](ElementId element) {
    if (seen_[element]) {
      return;
    }
    for (EntryId entry = mesh.first_entry[element]; entry < mesh.first_entry[element + 1]; ++entry) {
      // The link to a neighbour that was seen before is already counted.
      if (const LinkId link = mesh.entry_link[entry]; !seen_[mesh.neighbours[entry]] && !cuts.is_cut(link)) {
        sum.add(link_violation(mesh, softness, position, link));
      }
    }
    seen_[element] = true;
  });
  for_each_sampled(elements, nth, [&](ElementId element) { seen_[element] = false; });
  return sum.result();
}

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

Displacement measure_displacement(const Mesh& mesh, const PositionView& position) {
  Displacement result;
  double sum = 0;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    double square = 0;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const double moved = position(e, k) - mesh.rest[std::size_t{e} * mesh.space_dimension + k];
      square += moved * moved;
    }
    result.max = std::max(result.max, square);
    sum += square;
  }
  result.max = std::sqrt(result.max);
  result.rms = mesh.element_count() == 0 ? 0 : std::sqrt(sum / mesh.element_count());
  return result;
}

}  // namespace chainmail

#include "measure/violation.h"

#include <algorithm>
#include <cmath>

#include "solve/region.h"

namespace chainmail {
namespace {

template <int Dimension>
double excess(const Mesh& mesh, const LinkSoftness& softness, const PositionView& position, ElementId a, ElementId b) {
  const auto region = valid_region<double, Dimension>(mesh, a, b, softness);
  double square = 0;
  for (int k = 0; k < Dimension; ++k) {
    const double vector = position.between(a, b, k);
    const double outside = std::max({region.low[k] - vector, vector - region.high[k], 0.0});
    square += outside * outside;
  }
  return std::sqrt(square);
}

/// Gathers links one by one.
struct Gather {
  Violation result;
  double squares = 0;

  void add(double violation) {
    ++result.links;
    result.max = std::max(result.max, violation);
    squares += violation * violation;
    result.fraction += violation > counts_as_violated ? 1 : 0;
  }
  Violation finish() {
    if (result.links != 0) {
      result.rms = std::sqrt(squares / double(result.links));
      result.fraction /= double(result.links);
    }
    return result;
  }
};

}  // namespace

double link_violation(const Mesh& mesh, const Softness& softness, const PositionView& position, LinkId link) {
  const auto [a, b] = mesh.links[link];
  const LinkSoftness& of_link = softness.of(link);
  const double outside = mesh.space_dimension == 1   ? excess<1>(mesh, of_link, position, a, b)
                         : mesh.space_dimension == 2 ? excess<2>(mesh, of_link, position, a, b)
                                                     : excess<3>(mesh, of_link, position, a, b);
  if (outside == 0) {
    return 0;
  }
  const double length = rest_length(mesh, link);
  return outside / (length > 0 ? length : mesh.mean_link_length > 0 ? mesh.mean_link_length : 1);
}

Violation measure_violation(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                            const PositionView& position) {
  Gather gather;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    if (!cuts.is_cut(link)) {
      gather.add(link_violation(mesh, softness, position, link));
    }
  }
  return gather.finish();
}

Violation measure_violation(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                            std::span<const ElementId> elements) {
  Gather gather;
  for (const ElementId element : elements) {
    for (EntryId entry = mesh.first_entry[element]; entry < mesh.first_entry[element + 1]; ++entry) {
      if (const LinkId link = mesh.entry_link[entry]; !cuts.is_cut(link)) {
        gather.add(link_violation(mesh, softness, position, link));
      }
    }
  }
  return gather.finish();
}

double elastic_energy(const Mesh& mesh, const Cuts& cuts, const PositionView& position) {
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

#include "measure/distance.h"

#include <algorithm>
#include <cmath>

#include "measure/violation.h"

namespace chainmail {

Distance measure_distance(const Mesh& mesh, const PositionView& one, const PositionView& other) {
  Distance result;
  double sum = 0;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    double square = 0;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const double apart = one(e, k) - other(e, k);
      square += apart * apart;
    }
    result.max = std::max(result.max, square);
    sum += square;
  }
  const double unit = mesh.mean_link_length > 0 ? mesh.mean_link_length : 1;
  result.max = std::sqrt(result.max) / unit;
  result.rms = mesh.element_count() == 0 ? 0 : std::sqrt(sum / mesh.element_count()) / unit;
  return result;
}

std::optional<double> energy_ratio(double energy, double of_reference) {
  return of_reference > 0 ? std::optional(energy / of_reference) : std::nullopt;
}

std::optional<double> largest_over_hand(const Mesh& mesh, const PositionView& positions, ElementId hand) {
  double square = 0;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    const double moved = positions(hand, k) - mesh.rest[std::size_t{hand} * mesh.space_dimension + k];
    square += moved * moved;
  }
  return square > 0 ? std::optional(measure_displacement(mesh, positions).max / std::sqrt(square)) : std::nullopt;
}

}  // namespace chainmail

#include "measure/distance.h"

#include <algorithm>
#include <cmath>

#include "measure/violation.h"

namespace chainmail {
namespace {

// A handle that returned to its rest position is off by rounding errors: a ratio to them has no meaning.
constexpr double counts_as_moved = 1e-4;

/// Mean rest length, or mesh units where there is none.
double unit_of(const Mesh& mesh) { return mesh.mean_link_length > 0 ? mesh.mean_link_length : 1; }

}  // namespace

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
  const double unit = unit_of(mesh);
  result.max = std::sqrt(result.max) / unit;
  result.rms = mesh.element_count() == 0 ? 0 : std::sqrt(sum / mesh.element_count()) / unit;
  return result;
}

std::optional<double> energy_ratio(double energy, double of_reference) {
  return of_reference > 0 ? std::optional(energy / of_reference) : std::nullopt;
}

std::optional<double> largest_over_handle(const Mesh& mesh, const PositionView& positions,
                                          std::span<const ElementId> handle) {
  double largest = 0;  // squared
  for (const ElementId element : handle) {
    double square = 0;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const double moved = positions(element, k) - mesh.rest[std::size_t{element} * mesh.space_dimension + k];
      square += moved * moved;
    }
    largest = std::max(largest, square);
  }
  const double of_handle = std::sqrt(largest);
  return of_handle > counts_as_moved * unit_of(mesh)
             ? std::optional(measure_displacement(mesh, positions).max / of_handle)
             : std::nullopt;
}

}  // namespace chainmail

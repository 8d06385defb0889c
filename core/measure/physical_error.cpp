#include "measure/physical_error.h"

#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

/// Sum and maximum of squared distances.
struct Squares {
  double sum = 0, largest = 0;
  std::uint64_t count = 0;

  void add(double square) {
    sum += square;
    largest = std::max(largest, square);
    ++count;
  }
  double rms() const { return count == 0 ? 0 : std::sqrt(sum / double(count)); }
};

}  // namespace

PhysicalError measure_physical_error(const Mesh& mesh, const PositionView& positions,
                                     const ReferenceSolution& reference) {
  Squares all, moving, displacements, apart_of_relative;
  std::vector<bool> left_out(mesh.element_count(), false);
  if (reference.only_free) {
    for (const ElementId e : reference.prescribed) {
      left_out[e] = true;
    }
  }
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    double apart = 0, displacement = 0;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const std::size_t at = std::size_t{e} * static_cast<std::size_t>(mesh.space_dimension) + k;
      const double along_axis = (positions(e, k) - mesh.rest[at]) - reference.displacements[at];
      apart += along_axis * along_axis;
      displacement += reference.displacements[at] * reference.displacements[at];
    }
    all.add(apart);
    if (!left_out[e]) {
      apart_of_relative.add(apart);
      displacements.add(displacement);
    }
    if (std::sqrt(displacement) > counts_as_moving * reference.handle_displacement) {
      moving.add(apart);
    }
  }
  PhysicalError error;
  error.relative = apart_of_relative.rms() / displacements.rms();
  error.rms = all.rms() / reference.handle_displacement;
  error.max = std::sqrt(all.largest) / reference.handle_displacement;
  error.moving_rms = moving.rms() / reference.handle_displacement;
  error.moving_max = std::sqrt(moving.largest) / reference.handle_displacement;
  error.moving = moving.count;
  return error;
}

std::vector<double> positions_of_nothing_moving(const Mesh& mesh, const ReferenceSolution& reference) {
  const auto dimension = static_cast<std::size_t>(mesh.space_dimension);
  std::vector<double> positions = mesh.rest;
  for (const ElementId element : reference.prescribed) {
    for (std::size_t at = element * dimension; at < (element + 1) * dimension; ++at) {
      positions[at] = mesh.rest[at] + reference.displacements[at];
    }
  }
  return positions;
}

PhysicalError error_of_nothing_moving(const Mesh& mesh, const ReferenceSolution& reference) {
  const std::vector<double> positions = positions_of_nothing_moving(mesh, reference);
  const std::size_t stride = static_cast<std::size_t>(mesh.space_dimension) * sizeof(double);
  return measure_physical_error(mesh, PositionView(positions.data(), stride, Precision::double_precision), reference);
}

double rms_displacement(const Mesh& mesh, const ReferenceSolution& reference) {
  double sum = 0;
  for (const double along_axis : reference.displacements) {
    sum += along_axis * along_axis;
  }
  return std::sqrt(sum / double(mesh.element_count()));
}

}  // namespace chainmail

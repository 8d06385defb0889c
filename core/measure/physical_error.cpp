#include "measure/physical_error.h"

#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

/// Gathers squares of distances.
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

PhysicalError measure_physical_error(const Mesh& mesh, const PositionView& positions, const Truth& truth) {
  Squares all, moving;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    double error = 0, displacement = 0;
    for (int k = 0; k < mesh.space_dimension; ++k) {
      const std::size_t at = std::size_t{e} * static_cast<std::size_t>(mesh.space_dimension) + k;
      const double apart = (positions(e, k) - mesh.rest[at]) - truth.displacements[at];
      error += apart * apart;
      displacement += truth.displacements[at] * truth.displacements[at];
    }
    all.add(error);
    if (std::sqrt(displacement) > counts_as_moving * truth.hand) {
      moving.add(error);
    }
  }
  return {all.rms() / truth.hand, std::sqrt(all.largest) / truth.hand, moving.rms() / truth.hand,
          std::sqrt(moving.largest) / truth.hand, moving.count};
}

}  // namespace chainmail

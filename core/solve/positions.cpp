#include "solve/positions.h"

#include <array>
#include <limits>

namespace chainmail {

double position_limit(Precision precision) {
  return precision == Precision::single_precision ? double(std::numeric_limits<float>::max() / 16)
                                                  : std::numeric_limits<double>::max() / 16;
}

Point point_of(const Mesh& mesh, const PositionView& positions, ElementId element) {
  std::array<double, 3> carried{};
  for (int k = 0; k < mesh.space_dimension; ++k) {
    carried[k] = positions(element, k);
  }
  return mesh.to_point(carried.data());
}

}  // namespace chainmail

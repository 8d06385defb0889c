#pragma once

#include <array>
#include <optional>

#include "reference/object.h"

namespace reference {

/// Runs one sweep of the relaxation of thesis 2.1, literally and without a clamp. Each element in turn moves by the
/// share `step` towards the mean, over its neighbours, of their position minus the rest vector to them. This makes
/// elements jump (thesis 4.4).
template <class Scalar>
void relax(Object<Scalar>& object, Scalar step, std::optional<ElementId> held) {
  for (Element<Scalar>& element : object.elements) {
    if (element.identifier == held || element.neighbours.empty()) {
      continue;
    }
    std::array<Scalar, 3> sum{};
    for (const ElementId identifier : element.neighbours) {
      const Element<Scalar>& neighbour = object.element(identifier);
      for (int k = 0; k < object.space_dimension; ++k) {
        const double rest_vector = neighbour.original_position[k] - element.original_position[k];
        sum[k] += neighbour.current_position[k] - static_cast<Scalar>(rest_vector);
      }
    }
    for (int k = 0; k < object.space_dimension; ++k) {
      Scalar& x = element.current_position[k];
      x += step * (sum[k] / static_cast<Scalar>(element.neighbours.size()) - x);
    }
  }
}

}  // namespace reference

#include "report/run/shape_figures.h"

#include <algorithm>
#include <cmath>

#include "measure/hausdorff.h"
#include "measure/shape_measures.h"
#include "measure/violation.h"

namespace chainmail::report {

ShapeFigures shape_figures(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& positions,
                           const std::optional<PositionView>& reference) {
  return {reference ? std::optional(hausdorff_distance(mesh, positions, *reference)) : std::nullopt,
          chainmail::volume_change(mesh, positions), chainmail::inverted_cells(mesh, positions),
          largest_principal_stretch(mesh, positions), measure_violation(mesh, softness, cuts, positions).max};
}

void take_worst(ShapeFigures& worst, const ShapeFigures& other) {
  const auto larger = [](auto& one, const auto& than) { one = std::max(one, than); };  // none is below all others
  larger(worst.hausdorff, other.hausdorff);
  larger(worst.inverted_cells, other.inverted_cells);
  larger(worst.stretch, other.stretch);
  larger(worst.violation, other.violation);
  if (other.volume_change && std::abs(*other.volume_change) > std::abs(worst.volume_change.value_or(0))) {
    worst.volume_change = other.volume_change;
  }
}

}  // namespace chainmail::report

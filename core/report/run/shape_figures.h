#pragma once

#include <cstdint>
#include <optional>

#include "body/positions.h"
#include "body/softness.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail::report {

/// Figures about the shape of a deformed object at the end of a drag. Those that are not defined for the object are
/// none; see their headers in core/measure.
struct ShapeFigures {
  std::optional<double> hausdorff;              // distance of the surfaces from the reference (mean rest lengths)
  std::optional<double> volume_change;          // relative to rest
  std::optional<std::uint64_t> inverted_cells;  // number of them
  std::optional<double> stretch;                // the largest principal stretch
  double violation = 0;                         // the largest of a link (its rest lengths)

  bool operator==(const ShapeFigures&) const = default;
};

/// Measures the figures, with a reference if there is one.
ShapeFigures shape_figures(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& positions,
                           const std::optional<PositionView>& reference);

/// Takes over what is worse in `other`.
void take_worst(ShapeFigures& worst, const ShapeFigures& other);

}  // namespace chainmail::report

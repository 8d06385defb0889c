#pragma once

#include <optional>

#include "mesh/mesh.h"
#include "solve/solver.h"

namespace chainmail {

/// How far the elements of one state of a mesh lie from those of another, in mean rest lengths of the
/// mesh (mesh units where it has none); Euclidean over the axes, in double whatever the solvers used.
struct Distance {
  double max = 0;
  double rms = 0;

  bool operator==(const Distance&) const = default;
};
Distance measure_distance(const Mesh& mesh, const PositionView& one, const PositionView& other);

/// Elastic energy over that of a reference; none where the reference holds none.
std::optional<double> energy_ratio(double energy, double of_reference);

/// The largest displacement of any element over that of the hand's element; none where the hand is back where
/// the element was at rest, to 1e-4 mean rest lengths. Above 1, something went further than it was pulled.
std::optional<double> largest_over_hand(const Mesh& mesh, const PositionView& positions, ElementId hand);

}  // namespace chainmail

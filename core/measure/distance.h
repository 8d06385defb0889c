#pragma once

#include <optional>
#include <span>

#include "mesh/mesh.h"
#include "solver/deformer.h"

namespace chainmail {

/// Distance between the elements of two states of a mesh, in mean rest lengths of the mesh (in mesh units if it has
/// none). Euclidean over the axes, in double.
struct Distance {
  double max = 0;
  double rms = 0;

  bool operator==(const Distance&) const = default;
};
Distance measure_distance(const Mesh& mesh, const PositionView& one, const PositionView& other);

/// Returns the elastic energy divided by that of a reference; none if the reference's energy is 0.
std::optional<double> energy_ratio(double energy, double of_reference);

/// Returns the largest displacement of any element divided by the largest one of the handle's elements; none if the
/// handle is at rest, to 1e-4 mean rest lengths, or if there is none. Above 1, an element moved further than the
/// handle.
std::optional<double> largest_over_handle(const Mesh& mesh, const PositionView& positions,
                                          std::span<const ElementId> handle);

}  // namespace chainmail

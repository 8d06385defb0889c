#pragma once

#include <cstdint>
#include <vector>

#include "measure/reference_solution.h"
#include "solver/deformer.h"

namespace chainmail {

/// An element belongs to the moving region if the reference solution displaces it by more than this share of the
/// handle's displacement.
inline constexpr double counts_as_moving = 0.01;

/// Distance of the elements from the reference solution. Euclidean over the axes, in double.
struct PhysicalError {
  /// RMS of the error divided by RMS of the reference's displacements, over all elements. About 1 for an object that
  /// does not move: a method with a larger error is worse than no method. With a reference for free elements alone,
  /// over those; then it is exactly 1.
  double relative = 0;
  // Errors divided by the handle's displacement. They look small because most elements of the reference move little.
  double rms = 0, max = 0;                // over all elements, including the handle and the pins
  double moving_rms = 0, moving_max = 0;  // over the moving region
  std::uint64_t moving = 0;               // number of elements in the moving region

  bool operator==(const PhysicalError&) const = default;
};

/// Returns the error of positions. The reference must be of this mesh.
PhysicalError measure_physical_error(const Mesh& mesh, const PositionView& positions,
                                     const ReferenceSolution& reference);
/// Returns the error of the null model: the handle and the pins are at their prescribed positions, and nothing else
/// moves.
PhysicalError error_of_nothing_moving(const Mesh& mesh, const ReferenceSolution& reference);

/// Returns the positions of the null model, space_dimension coordinates each (mesh units).
std::vector<double> positions_of_nothing_moving(const Mesh& mesh, const ReferenceSolution& reference);

/// Returns the RMS of the reference's displacements over all elements (mesh units).
double rms_displacement(const Mesh& mesh, const ReferenceSolution& reference);

}  // namespace chainmail

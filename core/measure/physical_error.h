#pragma once

#include <cstdint>

#include "measure/reference_solution.h"
#include "solve/solver.h"

namespace chainmail {

/// An element that the reference solution displaces by more than this share of the handle's displacement belongs to the
/// region that moves.
inline constexpr double counts_as_moving = 0.01;

/// How far elements stand from the reference solution. Euclidean over the axes, in double whatever the solver used.
struct PhysicalError {
  /// RMS of the error over RMS of the reference's displacements, over all elements. An object that does not move has
  /// about 1: a method above that is worse than no method.
  double relative = 0;
  // Over the handle's displacement: 0.1 is a tenth of the way that the handle went. These hide that most elements of
  // the reference move little.
  double rms = 0, max = 0;                // over all elements, the handle's and the pinned among them
  double moving_rms = 0, moving_max = 0;  // over the region that moves in the reference
  std::uint64_t moving = 0;               // elements in that region

  bool operator==(const PhysicalError&) const = default;
};

/// The reference must be of this mesh.
PhysicalError measure_physical_error(const Mesh& mesh, const PositionView& positions,
                                     const ReferenceSolution& reference);
/// The null model: the handle and the pins stand where they are prescribed, and nothing else moves.
PhysicalError error_of_nothing_moving(const Mesh& mesh, const ReferenceSolution& reference);

/// RMS of the reference's displacements over all elements (mesh units).
double rms_displacement(const Mesh& mesh, const ReferenceSolution& reference);

}  // namespace chainmail

#pragma once

#include <cstdint>

#include "measure/truth.h"
#include "solve/solver.h"

namespace chainmail {

/// An element that the truth displaces by more than this share of the hand's displacement belongs to the region that
/// moves.
inline constexpr double counts_as_moving = 0.01;

/// How far elements stand from where the truth has them, over the hand's displacement: 0.1 is a tenth of the way that
/// the hand went. Euclidean over the axes, in double whatever the solver used.
struct PhysicalError {
  double rms = 0, max = 0;                // over all elements, the hand's and the pinned among them
  double moving_rms = 0, moving_max = 0;  // over the region that moves in the truth
  std::uint64_t moving = 0;               // elements in that region

  bool operator==(const PhysicalError&) const = default;
};

/// The truth must be of this mesh.
PhysicalError measure_physical_error(const Mesh& mesh, const PositionView& positions, const Truth& truth);

}  // namespace chainmail

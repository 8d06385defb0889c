#pragma once

#include <cstdint>
#include <optional>

#include "equilibrium/relaxation_scheme.h"

namespace chainmail {

/// Result of a slice of relaxation: a part of a sweep, or one iteration toward the equilibrium.
struct RelaxationResult {
  std::uint64_t visited = 0;  // number of visited elements
  bool sweep_ended = false;   // true if the slice reached the end of a sweep, or was an iteration
  double largest_step = 0;    // of the sweep so far, Euclidean norm (mesh units)
  /// After an iteration: the estimated distance from the equilibrium, see EquilibriumCertificate.
  std::optional<double> residual = {};
  bool has_prepared = false;  // true if this iteration prepared later ones, which are much faster
};

}  // namespace chainmail

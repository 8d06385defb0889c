#pragma once

#include <cstdint>

namespace chainmail {

/// Relaxation scheme. `mean` moves each element toward the mean of the positions that its neighbours imply (thesis 2.1;
/// Frisken-Gibson 1999). `link` moves the two ends of each link, which share its deflection (Schill 2001).
enum class RelaxationScheme { mean, link };

/// Result of a slice of relaxation.
struct RelaxationResult {
  std::uint64_t visited = 0;  // number of visited elements
  bool sweep_ended = false;   // true if the slice reached the end of a sweep
  double largest_step = 0;    // of the sweep so far, Euclidean norm (mesh units)
};

}  // namespace chainmail

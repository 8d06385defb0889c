#pragma once

#include <cstdint>

namespace chainmail {

/// How elements follow their neighbours: `mean`, each toward the mean of where its neighbours would have
/// it (thesis 2.1; Frisken-Gibson 1999), or `link`, the two ends of each link sharing its deflection
/// (Schill 2001).
enum class RelaxationScheme { mean, link };

/// What a slice of relaxation did.
struct RelaxationResult {
  std::uint64_t visited = 0;  // elements looked at
  bool sweep_ended = false;   // the slice reached the end of a sweep
  double largest_step = 0;    // of the sweep so far, Euclidean (mesh units)
};

}  // namespace chainmail

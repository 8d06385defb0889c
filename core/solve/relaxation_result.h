#pragma once

#include <cstdint>

namespace chainmail {

/// What a slice of relaxation did.
struct RelaxationResult {
  std::uint64_t visited = 0;  // elements looked at
  bool sweep_ended = false;   // the slice reached the end of a sweep
  double largest_step = 0;    // of the sweep so far, Euclidean (mesh units)
};

}  // namespace chainmail

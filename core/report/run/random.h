#pragma once

#include <random>

namespace chainmail::report {

/// Returns a uniformly distributed number between `low` and `high`. Unlike the distributions of the standard library,
/// it is the same on every machine.
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace chainmail::report

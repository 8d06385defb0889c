#pragma once

#include <random>

namespace chainmail::report {

/// A uniform number: the same on every machine, which the standard's distributions do not promise.
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace chainmail::report

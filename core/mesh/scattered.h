#pragma once

#include <cstdint>

namespace chainmail {

/// Between the states of the generator.
inline constexpr std::uint64_t scatter_step = 0x9e3779b97f4a7c15;

/// Spreads the bits of a number: what follows this state (Steele et al. 2014, SplitMix).
inline std::uint64_t scattered(std::uint64_t z) {
  z += scatter_step;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace chainmail

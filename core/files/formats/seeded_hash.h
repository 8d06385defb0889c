#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>

namespace chainmail {

/// Hashes numbers with a random seed, so that no file can choose numbers with equal hashes. -0 and 0 must not both
/// occur.
class SeededHash {
 public:
  std::size_t operator()(std::span<const double> numbers) const {
    std::uint64_t hash = seed();
    for (const double number : numbers) {
      hash = mixed(hash ^ std::bit_cast<std::uint64_t>(number));
    }
    return hash;
  }

 private:
  static std::uint64_t seed() {
    static const std::uint64_t seed = std::random_device{}();
    return seed;
  }
  /// Spreads the bits of a number over all bits (the finalizer of SplitMix64, Steele et al. 2014).
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }
};

}  // namespace chainmail

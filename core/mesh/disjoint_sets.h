#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace chainmail {

/// Sets of numbers that grow together. Meant for many small sets: finding takes time in proportion to the set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// Returns the lowest number in the set of a number.
  std::size_t of(std::size_t one) const {
    while (parent_[one] != one) {
      one = parent_[one];
    }
    return one;
  }
  void unite(std::size_t one, std::size_t other) {
    one = of(one);
    other = of(other);
    parent_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace chainmail

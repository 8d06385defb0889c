#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace chainmail {

/// Disjoint sets of numbers from 0 that can be joined (Galler and Fischer 1964), with path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// Adds a set of the next number.
  void add() { parent_.push_back(parent_.size()); }
  /// Returns the number that names the set of a number: the lowest, if sets are only united.
  std::size_t of(std::size_t one) {
    while (parent_[one] != one) {
      one = parent_[one] = parent_[parent_[one]];
    }
    return one;
  }
  void unite(std::size_t one, std::size_t other) {
    one = of(one);
    other = of(other);
    join(std::min(one, other), std::max(one, other));
  }
  /// Joins two sets, given by the numbers that of() returns. Both then have the first number.
  void join(std::size_t into, std::size_t other) { parent_[other] = into; }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "exact/thread_team.h"

namespace chainmail {

/// Loops over elements, in blocks of a fixed size that the threads of a team share. Results have the same bits for any
/// number of threads.
class SharedLoop {
 public:
  /// On this thread alone.
  SharedLoop() = default;
  explicit SharedLoop(ThreadTeam& team) : team_(&team) {}

  /// Calls work(i) for all i below `count`, which is at most ThreadTeam::max_parts.
  template <class Work>
  void each(std::size_t count, Work work) const {
    if (team_ != nullptr && count > 1) {
      team_->run(count, work);
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        work(i);
      }
    }
  }
  /// Calls work(first, last) for all blocks below `count`.
  template <class Work>
  void run(std::size_t count, Work work) const {
    for_each_block(count, [&](std::size_t, std::size_t first, std::size_t last) { work(first, last); });
  }
  /// Returns the sum of term(first, last) over all blocks, in their order.
  template <class Term>
  double sum(std::size_t count, Term term) const {
    if (count <= block) {
      return count > 0 ? term(std::size_t{0}, count) : 0;
    }
    std::vector<double> terms((count + block - 1) / block);
    for_each_block(count,
                   [&](std::size_t number, std::size_t first, std::size_t last) { terms[number] = term(first, last); });
    double total = 0;
    for (const double one : terms) {
      total += one;
    }
    return total;
  }

 private:
  static constexpr std::size_t block = 4096;

  template <class Work>
  void for_each_block(std::size_t count, Work work) const {
    const std::size_t blocks = (count + block - 1) / block, parts = std::min(blocks, ThreadTeam::max_parts);
    each(parts, [&](std::size_t part) {
      for (std::size_t number = part; number < blocks; number += parts) {
        work(number, number * block, std::min(count, (number + 1) * block));
      }
    });
  }

  ThreadTeam* team_ = nullptr;
};

}  // namespace chainmail

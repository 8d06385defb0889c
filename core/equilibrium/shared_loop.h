#pragma once

#include <algorithm>
#include <atomic>
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
    // Where the coarser levels of a multigrid have few rows, each of them is long.
    constexpr std::size_t small = 512, usual_blocks = 16;
    for_each_block(count, std::clamp(count / usual_blocks, small, block),
                   [&](std::size_t, std::size_t first, std::size_t last) { work(first, last); });
  }
  /// Returns the sum of term(first, last) over all blocks, in their order.
  template <class Term>
  double sum(std::size_t count, Term term) const {
    if (count <= block) {
      return count > 0 ? term(std::size_t{0}, count) : 0;
    }
    double total = 0;
    for (const double one : terms_of(count, term)) {
      total += one;
    }
    return total;
  }
  /// Returns the largest term(first, last) of all blocks, at least 0.
  template <class Term>
  double largest(std::size_t count, Term term) const {
    double largest = 0;
    for (const double one : terms_of(count, term)) {
      largest = std::max(largest, one);
    }
    return largest;
  }
  /// Returns true if holds(i) for all i below `count`.
  template <class Holds>
  bool all(std::size_t count, Holds holds) const {
    std::atomic<bool> result = true;
    run(count, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last && result.load(std::memory_order_relaxed); ++i) {
        if (!holds(i)) {
          result.store(false, std::memory_order_relaxed);
        }
      }
    });
    return result.load();
  }

 private:
  static constexpr std::size_t block = 4096;

  template <class Term>
  std::vector<double> terms_of(std::size_t count, Term term) const {
    std::vector<double> terms((count + block - 1) / block);
    for_each_block(count, block,
                   [&](std::size_t number, std::size_t first, std::size_t last) { terms[number] = term(first, last); });
    return terms;
  }
  template <class Work>
  void for_each_block(std::size_t count, std::size_t size, Work work) const {
    const std::size_t blocks = (count + size - 1) / size, parts = std::min(blocks, ThreadTeam::max_parts);
    each(parts, [&](std::size_t part) {
      for (std::size_t number = part; number < blocks; number += parts) {
        work(number, number * size, std::min(count, (number + 1) * size));
      }
    });
  }

  ThreadTeam* team_ = nullptr;
};

/// The threads of loops over some elements: helpers come if the elements are worth it.
class LoopTeam {
 public:
  LoopTeam(int max_threads, std::size_t elements) : team_(max_threads) {
    if (max_threads > 1 && elements >= worth_helpers) {
      team_.call_helpers();
    }
  }
  SharedLoop loop() { return SharedLoop(team_); }

 private:
  // Less is done before a helper has come.
  static constexpr std::size_t worth_helpers = 8192;

  ThreadTeam team_;
};

}  // namespace chainmail

#pragma once

#include <atomic>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "exact/thread_team.h"

namespace chainmail {

template <class Signature>
class FunctionRef;

/// A function that belongs to the caller. Code that takes one is compiled once for all functions; a call is indirect.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Function>
  requires(!std::is_same_v<std::remove_cvref_t<Function>, FunctionRef>)
      // NOLINTNEXTLINE(google-explicit-constructor): functions are given as they are
      FunctionRef(Function&& function)
      : context_(&function), call_([](const void* context, Arguments... arguments) -> Result {
          return (*static_cast<const std::remove_cvref_t<Function>*>(context))(arguments...);
        }) {}
  Result operator()(Arguments... arguments) const { return call_(context_, arguments...); }

 private:
  const void* context_;
  Result (*call_)(const void* context, Arguments... arguments);
};

/// Loops over elements, in blocks of a fixed size that the threads of a team share. Results have the same bits for any
/// number of threads.
class SharedLoop {
 public:
  /// Works on the elements from the first to the one before the last.
  using Work = FunctionRef<void(std::size_t first, std::size_t last)>;
  using Term = FunctionRef<double(std::size_t first, std::size_t last)>;

  /// On this thread alone.
  SharedLoop() = default;
  explicit SharedLoop(ThreadTeam& team) : team_(&team) {}

  /// Calls work(i) for all i below `count`, which is at most ThreadTeam::max_parts.
  void each(std::size_t count, FunctionRef<void(std::size_t)> work) const;
  /// Calls work(first, last) for all blocks below `count`.
  void run(std::size_t count, Work work) const;
  /// Returns the sum of term(first, last) over all blocks, in their order.
  double sum(std::size_t count, Term term) const;
  /// Returns the largest term(first, last) of all blocks, at least 0.
  double largest(std::size_t count, Term term) const;
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
  std::vector<double> terms_of(std::size_t count, Term term) const;

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

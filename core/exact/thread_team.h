#pragma once

#include <cstddef>
#include <memory>

namespace chainmail {

/// Counts this thread as one that runs a pass, relaxes or measures, while it exists. Helpers of other passes give way
/// to it.
class RunningPass {
 public:
  RunningPass();
  RunningPass(const RunningPass&) = delete;
  RunningPass& operator=(const RunningPass&) = delete;
  ~RunningPass();
};

/// Threads that share the work of one pass: the one that made the team, and helpers.
///
/// The process has at most one helper per core but one. A team gets those that are free when it calls them, as long as
/// passes run on fewer threads than the machine has cores. A helper leaves its team when more threads run passes than
/// there are cores. So no work may depend on the number of threads that do it. A helper that waits for work in a team
/// keeps its core busy.
class ThreadTeam {
 public:
  /// A team of at most `max_threads` threads, this one included. It has no helpers yet, and costs nothing.
  explicit ThreadTeam(int max_threads);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;
  ~ThreadTeam();

  /// Gets helpers, unless the team has called them already. It takes some 10 µs until they are there.
  void call_helpers();

  /// Calls work(part) once for each part below `parts`, of which there may be at most `max_parts`, and returns when
  /// all are done. Parts run at the same time, in no order. Throws what a part threw, when no part runs any more.
  template <class Work>
  void run(std::size_t parts, Work work) {
    run(
        parts, [](void* context, std::size_t part) { (*static_cast<Work*>(context))(part); }, &work);
  }

  static constexpr std::size_t max_parts = 0xFFFF;

  struct Shared;  // what the threads of a team see

 private:
  using Call = void (*)(void* context, std::size_t part);
  void run(std::size_t parts, Call call, void* context);

  int max_threads_;
  bool has_called_ = false;
  std::unique_ptr<Shared> shared_;  // null: no helper
};

/// Number of cores of this machine, at least 1.
int core_count();

}  // namespace chainmail

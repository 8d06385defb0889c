#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "core/simulations.h"
#include "simulate/solver_thread.h"

namespace chainmail::test {

using namespace std::chrono_literals;

/// Waits for an event that takes milliseconds. The long limit is for a busy machine. This is the only sleep in the
/// tests: between two checks of the condition.
template <class Condition>
bool wait_until(Condition condition, std::chrono::steady_clock::duration limit = 30s) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

/// Waits for the frame after this number of passes. If relaxation is off and a pass was the last command, the frame
/// shows the final positions.
inline bool wait_for_passes(SolverThread& solver, std::uint64_t passes) {
  return wait_until([&] { return solver.idle() && solver.latest_frame().statistics.passes == passes; });
}

/// Returns the positions in the precision of a float solver.
inline std::vector<float> floats_of(const Simulation& simulation) {
  std::vector<float> positions(simulation.mesh().rest.size());
  simulation.body().copy_positions(std::span(positions));
  return positions;
}

/// A callback that can be made to wait, so that its solver stays busy as long as a test needs.
class Gate {
 public:
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  void open() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = false;
    }
    changed_.notify_all();
  }
  void pass() {
    std::unique_lock lock(mutex_);
    stands_ = closed_;
    changed_.wait(lock, [this] { return !closed_; });
    stands_ = false;
  }
  bool someone_stands() {
    const std::lock_guard lock(mutex_);
    return stands_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false;
  bool stands_ = false;
};

}  // namespace chainmail::test

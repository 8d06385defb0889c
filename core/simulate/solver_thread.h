#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "simulate/frame.h"
#include "simulate/simulation.h"

namespace chainmail {

/// Runs one Simulation on a thread of its own. It sleeps while there is nothing to do, relaxes in idle
/// time, and hands over a frame when something changed, at most 60 times a second.
class SolverThread {
 public:
  /// `frame_ready` is called after a frame was handed over, for the first frame here and from then on
  /// by the solver's thread; it must not wait.
  SolverThread(MeshPointer mesh, Algorithm algorithm, std::function<void()> frame_ready);
  /// Leaves the commands not yet begun undone.
  ~SolverThread();

  /// Adds a command to the end of the list.
  void post(Command command);
  /// Whether every command posted has been carried out.
  bool idle() const { return waiting_.load(std::memory_order_acquire) == 0; }
  /// The newest frame; for one reading thread.
  const Frame& latest_frame() { return frames_.latest(); }
  /// Takes the sentence of the last command that was refused, if any.
  std::string take_error();

 private:
  void run(const std::stop_token& stop);
  void refuse(const std::string& sentence);
  void carry_out(const Command& command);
  void relax();
  void rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void publish(bool at_rest);
  void note_changes();
  void fill(Frame& frame, ElementBlocks& pending);

  Simulation simulation_;
  std::function<void()> frame_ready_;
  TripleBuffer frames_;
  std::uint64_t frame_number_ = 0;
  MeshPointer shown_;                  // by the newest frame
  std::vector<std::uint64_t> stamps_;  // Frame::changed of the newest frame
  /// For each frame of the buffer, the blocks that changed since it was last filled.
  std::array<ElementBlocks, TripleBuffer::frame_count> pending_;
  PassTimes::Clock::time_point last_frame_{};
  PassTimes::Clock::time_point next_violation_{};
  std::uint64_t measured_passes_ = 0;
  bool unseen_ = false;   // something changed since the last frame
  bool measured_ = true;  // the last frame shows the violation of the whole mesh

  std::mutex mutex_;  // guards commands_ and error_
  std::condition_variable_any changed_;
  std::deque<Command> commands_;
  std::string error_;
  std::atomic<int> waiting_ = 0;  // commands posted and not yet carried out

  std::jthread thread_;  // last: it starts when all else stands, and ends first
};

}  // namespace chainmail

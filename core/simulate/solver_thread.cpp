#include "simulate/solver_thread.h"

#include <algorithm>
#include <new>
#include <utility>

#include "mesh/error.h"

namespace chainmail {
namespace {

using Clock = PassTimes::Clock;

constexpr auto frame_time = std::chrono::milliseconds(16);
// Relaxation takes this much of each frame's time, so that drawing and the other panel get the rest.
constexpr auto relaxation_share = std::chrono::milliseconds(8);
// A figure that is read by eye need not change more often.
constexpr auto violation_time = std::chrono::milliseconds(250);

}  // namespace

SolverThread::SolverThread(MeshPointer mesh, Algorithm algorithm, std::function<void()> frame_ready)
    : simulation_(std::move(mesh), algorithm, Precision::single_precision), frame_ready_(std::move(frame_ready)) {
  publish();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

SolverThread::~SolverThread() = default;

void SolverThread::post(Command command) {
  {
    const std::lock_guard lock(mutex_);
    commands_.push_back(std::move(command));
    waiting_.fetch_add(1, std::memory_order_release);
  }
  changed_.notify_one();
}

std::string SolverThread::take_error() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

void SolverThread::refuse(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  error_ = sentence;
}

void SolverThread::carry_out(const Command& command) {
  recorder_.begin(command, simulation_);
  try {
    simulation_.apply(command);
  } catch (const Error& error) {
    refuse(error.what());
  } catch (const std::bad_alloc&) {
    refuse("memory: there is not enough; use a smaller mesh");
  }
  recorder_.end(simulation_);
  unseen_ = true;
  measured_ = false;
  waiting_.fetch_sub(1, std::memory_order_release);
}

void SolverThread::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (!commands_.empty()) {
      const Command command = std::move(commands_.front());
      commands_.pop_front();
      lock.unlock();
      carry_out(command);
    } else if (simulation_.statistics().relaxing) {
      lock.unlock();
      relax();
    } else if (!unseen_ && measured_) {
      changed_.wait(lock, stop, [this] { return !commands_.empty(); });
      continue;
    } else {
      lock.unlock();
    }
    if (unseen_ && Clock::now() >= last_frame_ + frame_time) {
      refresh_figures();
      publish();
    }
    lock.lock();
    rest(lock, stop);
  }
}

void SolverThread::relax() {
  const auto end = Clock::now() + relaxation_share;
  while (idle() && Clock::now() < end && simulation_.step()) {
  }
  unseen_ = true;
  measured_ = false;
}

void SolverThread::rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const auto has_command = [this] { return !commands_.empty(); };
  if (unseen_ || simulation_.statistics().relaxing) {
    const auto share = simulation_.statistics().relaxing ? relaxation_share : frame_time.zero();
    changed_.wait_until(lock, stop, last_frame_ + frame_time - share, has_command);
  } else if (!measured_ && !changed_.wait_for(lock, stop, violation_time, has_command) && !stop.stop_requested()) {
    // Nothing came for a while: the object is at rest.
    lock.unlock();
    if (measure(stop)) {
      measured_ = true;
      publish();
    }
    lock.lock();
  }
}

/// The violation of the whole mesh, unless a command comes meanwhile; says whether it was measured.
bool SolverThread::measure(const std::stop_token& stop) {
  while (idle() && !stop.stop_requested()) {
    if (!simulation_.measure()) {
      return true;
    }
  }
  return false;
}

/// What is shown of passes while they go on.
void SolverThread::refresh_figures() {
  const auto now = Clock::now();
  // What moved since the object was at rest must not be shown with the figure of the whole mesh as it was.
  const bool outdated = simulation_.statistics().violation_of_whole_mesh;
  if (!simulation_.changed().empty() && (outdated || now >= next_violation_)) {
    simulation_.refresh_statistics(false);
    // After a pass through a large mesh it costs more than a pass: at most a tenth of the time goes there.
    next_violation_ = now + std::max<Clock::duration>(violation_time, 10 * (Clock::now() - now));
  }
}

void SolverThread::publish() {
  last_frame_ = Clock::now();
  recorder_.note_changes(simulation_);
  writer_.publish(simulation_);
  unseen_ = false;
  frame_ready_();
}

}  // namespace chainmail

#include "simulate/solver_thread.h"

#include <algorithm>
#include <new>
#include <span>
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

/// The stamps of a run of blocks, given by its elements.
std::span<std::uint64_t> blocks_of(std::span<std::uint64_t> stamps, ElementId first, ElementId end) {
  const std::size_t block = first / Frame::block_elements;
  return stamps.subspan(block, (end - 1) / Frame::block_elements - block + 1);
}

}  // namespace

SolverThread::SolverThread(MeshPointer mesh, Algorithm algorithm, std::function<void()> frame_ready)
    : simulation_(std::move(mesh), algorithm, Precision::single_precision), frame_ready_(std::move(frame_ready)) {
  publish(true);
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
  try {
    simulation_.apply(command);
  } catch (const Error& error) {
    refuse(error.what());
  } catch (const std::bad_alloc&) {
    refuse("memory: there is not enough; use a smaller mesh");
  }
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
      publish(false);
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
    publish(true);
    lock.lock();
  }
}

void SolverThread::publish(bool at_rest) {
  const auto now = Clock::now();
  const Statistics& statistics = simulation_.statistics();
  // The first pass after a rest must not show the figure of the whole mesh as it was.
  const bool outdated = statistics.violation_of_whole_mesh && statistics.passes != measured_passes_;
  if (at_rest || outdated || now >= next_violation_) {
    simulation_.refresh_statistics(at_rest);
    measured_passes_ = statistics.passes;
    // On a large mesh it costs more than a pass: at most a tenth of the time goes there.
    next_violation_ = now + std::max<Clock::duration>(violation_time, 10 * (Clock::now() - now));
  }
  ++frame_number_;
  note_changes();
  fill(frames_.back(), pending_[frames_.back_index()]);
  frames_.publish();
  last_frame_ = now;
  unseen_ = false;
  measured_ = at_rest;
  frame_ready_();
}

/// What changed since the last frame, in the stamps and for each frame that may be filled next.
void SolverThread::note_changes() {
  if (shown_ != simulation_.mesh_pointer()) {
    shown_ = simulation_.mesh_pointer();
    const ElementBlocks none(shown_->element_count());
    stamps_.assign(none.block_count(), 0);
    pending_.fill(none);
  }
  const ElementBlocks& changed = simulation_.changed();
  changed.for_each_run([this](ElementId first, ElementId end) {
    std::ranges::fill(blocks_of(std::span(stamps_), first, end), frame_number_);
  });
  for (ElementBlocks& pending : pending_) {
    pending.insert(changed);
  }
  simulation_.forget_changes();
}

/// A pending set is of the mesh last shown; a frame that was filled with another one lacks all of its blocks.
void SolverThread::fill(Frame& frame, ElementBlocks& pending) {
  const auto coordinates = static_cast<std::size_t>(shown_->space_dimension);
  frame.mesh = shown_;
  frame.positions.resize(shown_->rest.size());
  frame.changed.resize(stamps_.size());
  pending.for_each_run([&](ElementId first, ElementId end) {
    const auto positions = std::span(frame.positions).subspan(coordinates * first, coordinates * (end - first));
    simulation_.solver().copy_positions(first, positions);
    std::ranges::copy(blocks_of(std::span(stamps_), first, end), frame.changed.begin() + first / Frame::block_elements);
  });
  pending.clear();
  frame.statistics = simulation_.statistics();
  frame.number = frame_number_;
}

}  // namespace chainmail

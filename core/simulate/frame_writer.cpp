#include "simulate/frame_writer.h"

#include <algorithm>
#include <atomic>
#include <span>

namespace chainmail {
namespace {

/// Returns the frame numbers of the blocks that contain the elements from `first` to before `end`.
std::span<std::uint64_t> blocks_of(std::vector<std::uint64_t>& stamps, ElementId first, ElementId end) {
  const std::size_t block = first / Frame::block_elements;
  return std::span(stamps).subspan(block, (end - 1) / Frame::block_elements - block + 1);
}

}  // namespace

std::uint64_t new_series() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

void FrameWriter::publish(Simulation& simulation) {
  ++number_;
  note_changes(simulation);
  Frame& frame = frames_.begin();
  try {
    fill(frame, pending_[frames_.index()], simulation);
  } catch (...) {
    frames_.give_up();
    throw;
  }
  frames_.publish();
}

/// Records what changed since the last frame, for each of the two frames. For another mesh the simulation marks all
/// blocks as changed.
void FrameWriter::note_changes(Simulation& simulation) {
  if (mesh_ != simulation.mesh_pointer()) {
    mesh_.reset();  // until all is made for the new mesh: if memory runs out, the next frame starts again
    const ElementBlocks none(simulation.mesh().element_count());
    changed_.assign(none.block_count(), 0);
    pending_.fill(none);
    mesh_ = simulation.mesh_pointer();
  }
  simulation.changed().for_each_run(
      [this](ElementId first, ElementId end) { std::ranges::fill(blocks_of(changed_, first, end), number_); });
  for (ElementBlocks& pending : pending_) {
    pending.insert(simulation.changed());
  }
  simulation.forget_changes();
}

void FrameWriter::fill(Frame& frame, ElementBlocks& pending, Simulation& simulation) {
  const auto coordinates = static_cast<std::size_t>(mesh_->space_dimension);
  if (frame.mesh != mesh_) {
    frame.mesh = mesh_;
    frame.space = FrameSpace(*mesh_);
  }
  frame.positions.resize(mesh_->rest.size());
  frame.changed.resize(changed_.size());
  pending.for_each_run([&](ElementId first, ElementId end) {
    const auto run = std::span(frame.positions).subspan(coordinates * first, coordinates * (end - first));
    frame.space.copy(simulation.body(), first, run);
    std::ranges::copy(blocks_of(changed_, first, end), blocks_of(frame.changed, first, end).begin());
  });
  pending.clear();
  frame.statistics = simulation.statistics();
  frame.is_at_rest = simulation.body().is_at_rest();
  frame.statistics.relaxing = simulation.relaxes_in_idle_time();
  simulation.begin_frame();
  frame.number = number_;
  frame.series = series_;
}

}  // namespace chainmail

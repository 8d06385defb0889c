#include "drawing/cluster_boxes.h"

#include <algorithm>

namespace chainmail {
namespace {

ClusterBoxes::Box boxOf(std::span<const ElementId> elements, const Frame& frame) {
  ClusterBoxes::Box box;
  if (elements.empty()) {
    return box;
  }
  const int dimension = frame.mesh->space_dimension;
  std::copy_n(frame.positions.data() + std::size_t{elements.front()} * dimension, dimension, box.lowest.begin());
  box.highest = box.lowest;
  for (const ElementId e : elements) {
    const float* at = frame.positions.data() + std::size_t{e} * dimension;
    for (int k = 0; k < dimension; ++k) {
      box.lowest[k] = std::min(box.lowest[k], at[k]);
      box.highest[k] = std::max(box.highest[k], at[k]);
    }
  }
  return box;
}

}  // namespace

void ClusterBoxes::follow(const MeshLevelPointer& level, const Frame& frame) {
  if (level != level_ || frame.series != series_) {
    level_.reset();  // until all is made for the new one: if memory runs out, the next call starts again
    boxes_.resize(level->clusterCount());
    seen_.assign(level->clusterCount(), 0);
    prepared_.reset();
    level_ = level;
    series_ = frame.series;
  }
  frame_ = &frame;
}

bool ClusterBoxes::prepare(const MeshLevelPointer& level, const Frame& frame, std::chrono::milliseconds time) {
  constexpr std::size_t betweenLooks = 64;  // at the clock
  follow(level, frame);
  if (prepared_ == frame.number) {
    return true;
  }
  const auto end = std::chrono::steady_clock::now() + time;
  for (std::size_t cluster = 0; cluster < boxes_.size(); ++cluster) {
    (*this)[cluster];
    if (cluster % betweenLooks == 0 && std::chrono::steady_clock::now() > end) {
      return false;
    }
  }
  prepared_ = frame.number;
  return true;
}

const ClusterBoxes::Box& ClusterBoxes::operator[](std::size_t cluster) const {
  if (prepared_ != frame_->number && isOutdated(cluster)) {
    boxes_[cluster] = boxOf(level_->clusters[cluster], *frame_);
    seen_[cluster] = frame_->number;
  }
  return boxes_[cluster];
}

bool ClusterBoxes::isOutdated(std::size_t cluster) const {
  const auto blocks = level_->clusterBlocks[cluster];
  return seen_[cluster] == 0 ||
         std::any_of(blocks.begin(), blocks.end(), [&](auto block) { return frame_->changed[block] > seen_[cluster]; });
}

}  // namespace chainmail

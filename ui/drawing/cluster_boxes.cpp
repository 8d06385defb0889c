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
  if (level != level_) {
    level_ = level;
    seen_ = 0;
    boxes_.assign(level->clusterCount(), {});
  }
  if (frame.series != series_) {
    series_ = frame.series;
    seen_ = 0;
  }
  if (frame.number == seen_) {
    return;
  }
  for (std::size_t cluster = 0; cluster < boxes_.size(); ++cluster) {
    if (seen_ == 0 || isOutdated(cluster, frame)) {
      boxes_[cluster] = boxOf(level_->clusters[cluster], frame);
    }
  }
  seen_ = frame.number;
}

bool ClusterBoxes::isOutdated(std::size_t cluster, const Frame& frame) const {
  const auto blocks = level_->clusterBlocks[cluster];
  return std::any_of(blocks.begin(), blocks.end(), [&](auto block) { return frame.changed[block] > seen_; });
}

}  // namespace chainmail

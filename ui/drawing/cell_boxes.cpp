#include "drawing/cell_boxes.h"

#include <algorithm>

namespace chainmail {
namespace {

CellBoxes::Box boxOf(std::span<const ElementId> elements, const Frame& frame) {
  CellBoxes::Box box;
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

void CellBoxes::follow(const MeshLevelPointer& level, const Frame& frame) {
  if (level != level_) {
    level_ = level;
    seen_ = 0;
    boxes_.assign(level->cellCount(), {});
  }
  if (frame.series != series_) {
    series_ = frame.series;
    seen_ = 0;
  }
  if (frame.number == seen_) {
    return;
  }
  for (std::size_t cell = 0; cell < boxes_.size(); ++cell) {
    if (seen_ == 0 || isOutdated(cell, frame)) {
      boxes_[cell] = boxOf(level_->cells[cell], frame);
    }
  }
  seen_ = frame.number;
}

bool CellBoxes::isOutdated(std::size_t cell, const Frame& frame) const {
  const auto blocks = level_->cellBlocks[cell];
  return std::any_of(blocks.begin(), blocks.end(), [&](auto block) { return frame.changed[block] > seen_; });
}

}  // namespace chainmail

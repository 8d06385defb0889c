#include "drawing/surface_normals.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace chainmail {
namespace {

// If more elements than this fraction are outdated, computing all of them is faster.
constexpr double minForAll = 0.4;
// An element is at a crease if the normal of a face around it differs more than this from their mean (cosine of 38°).
constexpr float creaseCosine = 0.79F;

QVector3D positionOf(const Frame& frame, ElementId element) {
  const float* at = frame.positions.data() + std::size_t{3} * element;
  return {at[0], at[1], at[2]};
}

std::size_t blocksOf(std::size_t elements) { return (elements + Frame::block_elements - 1) / Frame::block_elements; }

}  // namespace

void SurfaceNormals::setFaces(std::vector<ElementId> corners, std::size_t elements) {
  corners_ = std::move(corners);
  first_.assign(elements + 1, 0);
  for (const ElementId corner : corners_) {
    ++first_[corner + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  around_.resize(corners_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    around_[next[corners_[i]]++] = std::uint32_t(i / 3);
  }
  normals_.assign(elements, {});
  marked_.assign(elements, false);
  number_ = 0;
}

void SurfaceNormals::follow(const Frame& frame) {
  changed_.clear();
  if (number_ == frame.number && series_ == frame.series) {
    return;
  }
  outdated_.clear();
  const bool known = number_ != 0 && series_ == frame.series;
  if (known) {
    collect(frame);
  }
  if (!known || double(outdated_.size()) > minForAll * double(normals_.size())) {
    computeAll(frame);
  } else {
    computeAround(frame);
  }
  for (const ElementId element : outdated_) {
    marked_[element] = false;
  }
  number_ = frame.number;
  series_ = frame.series;
}

/// Collects the corners of all faces around elements that may have moved.
void SurfaceNormals::collect(const Frame& frame) {
  for (std::size_t block = 0; block < frame.changed.size(); ++block) {
    if (frame.changed[block] <= number_) {
      continue;
    }
    const std::size_t begin = block * Frame::block_elements;
    const std::size_t end = std::min(begin + Frame::block_elements, normals_.size());
    for (std::size_t i = first_[begin]; i < first_[end]; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const ElementId corner = corners_[std::size_t{3} * around_[i] + k];
        if (!marked_[corner]) {
          marked_[corner] = true;
          outdated_.push_back(corner);
        }
      }
    }
  }
}

QVector3D SurfaceNormals::faceNormal(const Frame& frame, std::uint32_t face) const {
  const ElementId* corner = corners_.data() + std::size_t{3} * face;
  const QVector3D from = positionOf(frame, corner[0]);
  return QVector3D::crossProduct(positionOf(frame, corner[1]) - from, positionOf(frame, corner[2]) - from);
}

/// Returns the sum of the normals of the faces around an element, or 0 at a crease.
QVector3D SurfaceNormals::normalAt(const Frame& frame, ElementId element) const {
  const auto faces = std::span(around_).subspan(first_[element], first_[element + 1] - first_[element]);
  QVector3D sum;
  for (const std::uint32_t face : faces) {
    sum += faceNormal(frame, face);
  }
  const float least = creaseCosine * creaseCosine * sum.lengthSquared();
  for (const std::uint32_t face : faces) {
    const QVector3D normal = faceNormal(frame, face);
    const float along = QVector3D::dotProduct(normal, sum);
    if (along < 0 || along * along < least * normal.lengthSquared()) {
      return {};
    }
  }
  return sum;
}

void SurfaceNormals::computeAll(const Frame& frame) {
  for (ElementId element = 0; element < normals_.size(); ++element) {
    normals_[element] = normalAt(frame, element);
  }
  changed_ = {{0, blocksOf(normals_.size())}};
}

void SurfaceNormals::computeAround(const Frame& frame) {
  outdatedBlocks_.assign(blocksOf(normals_.size()), false);
  for (const ElementId element : outdated_) {
    normals_[element] = normalAt(frame, element);
    outdatedBlocks_[element / Frame::block_elements] = true;
  }
  for (std::size_t block = 0; block < outdatedBlocks_.size(); ++block) {
    const std::size_t first = block;
    while (block < outdatedBlocks_.size() && outdatedBlocks_[block]) {
      ++block;
    }
    if (block > first) {
      changed_.push_back({first, block});
    }
  }
}

}  // namespace chainmail

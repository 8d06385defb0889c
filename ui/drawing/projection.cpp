#include "drawing/projection.h"

#include <algorithm>
#include <cmath>

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

// Upper bound of the rounding error of a sum of four products in single precision, as a fraction of the sum of their
// magnitudes.
constexpr double projectionRounding = 8 * std::numeric_limits<float>::epsilon();

// The view extends from -1 to 1 in clip coordinates. The margin allows for the width of lines and marks, and for
// rounding.
constexpr double viewEdge = 1.05;

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

QMatrix4x4 meshToWorld(const Mesh& mesh) {
  const Point constant = FrameSpace(mesh).into(mesh.origin);
  QMatrix4x4 matrix;
  matrix.fill(0);
  matrix(3, 3) = 1;
  for (int k = 0; k < 3; ++k) {
    matrix(k, 3) = float(constant[k]);
  }
  for (int k = 0; k < mesh.space_dimension; ++k) {
    matrix(mesh.axes[k], k) = 1;
    matrix(mesh.axes[k], 3) = 0;
  }
  return matrix;
}

void ViewBounds::unite(const ViewBounds& other) {
  left = std::min(left, other.left);
  top = std::min(top, other.top);
  right = std::max(right, other.right);
  bottom = std::max(bottom, other.bottom);
}

bool ViewBounds::meets(const QRectF& rectangle) const {
  return !empty() && !(right < rectangle.left() || left > rectangle.right() || bottom < rectangle.top() ||
                       top > rectangle.bottom());
}

/// Returns false if the bounds of the segment are elsewhere, or if all corners are on one side of its line.
bool ViewBounds::meets(const QLineF& segment) const {
  if (!meets(QRectF(segment.p1(), segment.p2()).normalized())) {
    return false;
  }
  const auto across = [&](double x, double y) {
    return segment.dx() * (y - segment.y1()) - segment.dy() * (x - segment.x1());
  };
  const auto [lowest, highest] =
      std::minmax({across(left, top), across(left, bottom), across(right, top), across(right, bottom)});
  return !(lowest > 0 || highest < 0);
}

Projection::Projection(const Mesh& mesh, const QMatrix4x4& toView, const QMatrix4x4& toClip, QSizeF view)
    : matrix_(toClip * toView * meshToWorld(mesh)), dimension_(mesh.space_dimension), view_(view) {
  // Pixels per mesh unit along the vertical of the view, at distance 1 in perspective.
  pixelsPerDepth_ = float(toClip(1, 1) * view.height() / 2);
  const bool parallel = toClip(3, 3) != 0;
  pixelsPerZ_ = parallel ? -pixelsPerDepth_ / toClip(2, 2) : 0;
}

Projection::Place Projection::operator()(const float* coordinates) const {
  const float* m = matrix_.constData();  // column by column
  float clip[4]{m[12], m[13], m[14], m[15]};
  for (int k = 0; k < dimension_; ++k) {
    for (int row = 0; row < 4; ++row) {
      clip[row] += m[4 * k + row] * coordinates[k];
    }
  }
  const float w = clip[3];
  return {(clip[0] / w + 1) / 2 * float(view_.width()), (1 - clip[1] / w) / 2 * float(view_.height()), w, clip[2]};
}

float Projection::depth(const Place& place) const {
  // At a distance w from the eye, a unit of depth is pixelsPerDepth_ / w pixels long.
  return pixelsPerZ_ != 0 ? pixelsPerZ_ * place.z : pixelsPerDepth_ * std::log(place.distance);
}

std::array<double, 4> Projection::clipped(const ClusterBoxes::Box& box, int corner) const {
  const float* m = matrix_.constData();
  std::array<double, 4> clip{m[12], m[13], m[14], m[15]};
  for (int k = 0; k < dimension_; ++k) {
    const double at = (corner >> k & 1) != 0 ? box.highest[k] : box.lowest[k];
    for (int row = 0; row < 4; ++row) {
      clip[row] += m[4 * k + row] * at;
    }
  }
  return clip;
}

unsigned Projection::beyond(const ClusterBoxes::Box& box) const {
  unsigned sides = 31;
  for (int corner = 0; corner < 1 << dimension_ && sides != 0; ++corner) {
    const auto clip = clipped(box, corner);
    const double edge = viewEdge * clip[3];
    sides &= unsigned(clip[0] > edge) | unsigned(clip[0] < -edge) << 1 | unsigned(clip[1] > edge) << 2 |
             unsigned(clip[1] < -edge) << 3 | unsigned(clip[3] < 0) << 4;
  }
  return sides;
}

/// Uses only the corners: the projection of a convex body in front of the eye is within the bounds of its projected
/// corners.
ViewBounds Projection::bounds(const ClusterBoxes::Box& box) const {
  const float* m = matrix_.constData();
  std::array<double, 4> size{};  // sum of the magnitudes of the terms of each row
  for (int row = 0; row < 4; ++row) {
    size[row] = std::abs(m[12 + row]);
    for (int k = 0; k < dimension_; ++k) {
      size[row] += std::abs(double(m[4 * k + row])) * std::max(std::abs(box.lowest[k]), std::abs(box.highest[k]));
    }
  }
  ViewBounds result;
  double nearest = std::numeric_limits<double>::max(), furthest = -nearest;
  for (int corner = 0; corner < 1 << dimension_; ++corner) {
    const auto clip = clipped(box, corner);
    nearest = std::min(nearest, clip[3]);
    furthest = std::max(furthest, clip[3]);
    const double x = (clip[0] / clip[3] + 1) / 2 * view_.width(), y = (1 - clip[1] / clip[3]) / 2 * view_.height();
    result.unite({x, y, x, y});
  }
  const double ofDistance = projectionRounding * size[3];
  if (furthest < -ofDistance) {
    return {};
  }
  if (!(nearest > 4 * ofDistance)) {
    return ViewBounds::everywhere();
  }
  // A position is x / w. Its error has two parts: the error of x, and the error of w times the position.
  const double spanX = 1 + std::max(std::abs(result.left), std::abs(result.right)) / view_.width();
  const double spanY = 1 + std::max(std::abs(result.top), std::abs(result.bottom)) / view_.height();
  const double offX = 2 * (projectionRounding * size[0] + ofDistance * 2 * spanX) / nearest * view_.width();
  const double offY = 2 * (projectionRounding * size[1] + ofDistance * 2 * spanY) / nearest * view_.height();
  return {result.left - offX, result.top - offY, result.right + offX, result.bottom + offY};
}

}  // namespace chainmail

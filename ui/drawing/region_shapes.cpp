#include "drawing/region_shapes.h"

#include <cmath>

#include "drawing/camera.h"

namespace chainmail {
namespace {

constexpr float barPixels = 9;  // on each side of the line
constexpr float dashPixels = 4;
constexpr int maxDashes = 400;  // per edge: more are indistinguishable

}  // namespace

RegionShape::RegionShape(const NeighbourRegion& region, const FrameSpace& space, const QMatrix4x4& toView,
                         int spaceDimension, double unitsPerPixel)
    : at_(asVector(space.into(region.at))), nearest_(asVector(space.into(region.nearest))) {
  const auto pixel = float(unitsPerPixel / space.unit());
  right_ = toView.row(0).toVector3D().normalized() * pixel;
  up_ = toView.row(1).toVector3D().normalized() * pixel;
  for (int i = 0; i < 8; ++i) {
    corners_[std::size_t(i)] = asVector(space.into(region.corner(i)));
  }
  if (spaceDimension == 1) {
    // The bar is horizontal or vertical, across the axis of the mesh.
    const QVector3D low = asVector(space.into(region.low)), high = asVector(space.into(region.high));
    const QVector3D along = (high - low).normalized();
    const bool upright = std::abs(QVector3D::dotProduct(along, up_)) > std::abs(QVector3D::dotProduct(along, right_));
    const QVector3D across = (upright ? right_ : up_) * barPixels;
    corners_ = {low - across, high - across, low + across, high + across,
                low - across, high - across, low + across, high + across};
  }
}

std::vector<QVector3D> RegionShape::faces() const {
  std::vector<QVector3D> triangles;
  for (int k = 0; k < 3; ++k) {
    const int a = 1 << (k + 1) % 3, b = 1 << (k + 2) % 3;
    for (const int from : {0, 1 << k}) {
      for (const int corner : {from, from + a, from + b, from + a, from + b, from + a + b}) {
        triangles.push_back(corners_[std::size_t(corner)]);
      }
    }
  }
  return triangles;
}

std::vector<QVector3D> RegionShape::edges() const {
  std::vector<QVector3D> ends;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) {
      const QVector3D &from = corners_[std::size_t(i)], &to = corners_[std::size_t(i | 1 << k)];
      if ((i >> k & 1) == 0 && from != to) {
        ends.insert(ends.end(), {from, to});
      }
    }
  }
  return ends;
}

std::vector<QVector3D> RegionShape::dashedEdges() const {
  const auto whole = edges();
  std::vector<QVector3D> ends;
  for (std::size_t i = 0; i < whole.size(); i += 2) {
    const QVector3D along = whole[i + 1] - whole[i];
    const double dashes = along.length() / (dashPixels * up_.length());
    const int count = int(std::min<double>(maxDashes, std::ceil(dashes))) | 1;  // odd, so that both ends are drawn
    for (int dash = 0; dash < count; dash += 2) {
      ends.push_back(whole[i] + along * (float(dash) / float(count)));
      ends.push_back(whole[i] + along * (float(dash + 1) / float(count)));
    }
  }
  return ends;
}

std::vector<QVector3D> RegionShape::cross(double pixels) const {
  const QVector3D right = right_ * float(pixels), up = up_ * float(pixels);
  return {at_ - right - up, at_ + right + up, at_ - right + up, at_ + right - up};
}

}  // namespace chainmail

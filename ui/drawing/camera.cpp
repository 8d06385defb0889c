#include "drawing/camera.h"

#include <cmath>
#include <limits>
#include <vector>

namespace chainmail {
namespace {

constexpr double fieldOfView = 35;  // degrees, vertical
constexpr double fitMargin = 1.12;  // size of the view, divided by the size of the fitted object
constexpr double degreesPerPixel = 0.4;
constexpr double smallestHeight = 1e-5, largestHeight = 1e3;  // visible height, in radii of the object

struct Extent {
  QVector3D lowest, highest;
};

Extent extentOf(std::span<const QVector3D> points) {
  Extent extent{points[0], points[0]};
  for (const QVector3D& point : points) {
    for (int k = 0; k < 3; ++k) {
      extent.lowest[k] = std::min(extent.lowest[k], point[k]);
      extent.highest[k] = std::max(extent.highest[k], point[k]);
    }
  }
  return extent;
}

double eyeDistance(double height) { return height / 2 / std::tan(fieldOfView / 2 * M_PI / 180); }

}  // namespace

std::array<QVector3D, 8> cornersOf(const std::array<Point, 2>& box) {
  std::array<QVector3D, 8> corners;
  for (unsigned corner = 0; corner < corners.size(); ++corner) {
    for (unsigned k = 0; k < 3; ++k) {
      corners[corner][int(k)] = float(box[corner >> k & 1U][k]);
    }
  }
  return corners;
}

void Camera::fit(const std::array<Point, 2>& box, std::span<const int> axes, QSizeF view) {
  const auto carries = [axes](int k) { return std::find(axes.begin(), axes.end(), k) != axes.end(); };
  spatial_ = axes.size() == 3;
  // The camera looks at an xz plane from above and at a yz plane from the side.
  const bool fromAbove = !spatial_ && carries(2) && carries(0), fromSide = !spatial_ && carries(2) && !carries(0);
  yaw_ = spatial_ ? -30 : fromSide ? -90 : 0;
  pitch_ = spatial_ ? 25 : fromAbove ? 90 : 0;
  frame(cornersOf(box), view);
}

void Camera::frame(std::span<const QVector3D> points, QSizeF view) {
  if (points.empty()) {
    return;
  }
  const Extent extent = extentOf(points);
  const QVector3D middle = (extent.lowest + extent.highest) / 2;
  radius_ = std::max(double((extent.highest - extent.lowest).length()) / 2, 1e-9);
  centre_ = middle;
  const QMatrix4x4 turn = rotation();
  std::vector<QVector3D> turned(points.size());
  std::ranges::transform(points, turned.begin(), [&](const QVector3D& point) { return turn.map(point - middle); });
  const double aspect = view.width() / std::max(view.height(), 1.0);
  spatial_ && !parallel_ ? frameInPerspective(turned, aspect) : frameFlat(turned, aspect);
  height_ = std::clamp(height_, radius_ * smallestHeight, radius_ * largestHeight);
  framed_ = true;
}

/// `turned` are positions relative to centre_ on the axes of the view.
void Camera::frameFlat(std::span<const QVector3D> turned, double aspect) {
  const Extent extent = extentOf(turned);
  const QVector3D size = extent.highest - extent.lowest, middle = (extent.lowest + extent.highest) / 2;
  const double height = std::max(double(size.y()), double(size.x()) / aspect);
  height_ = fitMargin * (height > 0 ? height : 2 * radius_);
  centre_ += rotation().transposed().map(QVector3D(middle.x(), middle.y(), 0));
}

/// Finds the nearest eye for which all points are inside the four sides of the view. Each side is a plane through the
/// eye, so each of them depends only on the point that is farthest in its direction.
void Camera::frameInPerspective(std::span<const QVector3D> turned, double aspect) {
  const double slope = std::tan(fieldOfView / 2 * M_PI / 180), up = slope / fitMargin, across = up * aspect;
  constexpr double least = std::numeric_limits<double>::lowest();
  double right = least, left = least, top = least, bottom = least;
  for (const QVector3D& point : turned) {
    const double x = double(point.x()), y = double(point.y()), z = double(point.z());
    right = std::max(right, x + across * z);
    left = std::max(left, -x + across * z);
    top = std::max(top, y + up * z);
    bottom = std::max(bottom, -y + up * z);
  }
  const double distance = std::max((right + left) / 2 / across, (top + bottom) / 2 / up);
  height_ = 2 * slope * distance;
  centre_ += rotation().transposed().map(QVector3D(float((right - left) / 2), float((top - bottom) / 2), 0));
}

void Camera::setPose(const Pose& pose) {
  centre_ = pose.centre;
  parallel_ = pose.parallel;
  framed_ = pose.framed;
  up_ = pose.up;
  height_ = std::clamp(pose.height, radius_ * smallestHeight, radius_ * largestHeight);
  if (spatial_) {
    yaw_ = pose.yaw;
    pitch_ = std::clamp(pose.pitch, -90.0, 90.0);
  }
}

void Camera::orbit(QPointF pixels) {
  if (spatial_) {
    yaw_ += pixels.x() * degreesPerPixel;
    pitch_ = std::clamp(pitch_ + pixels.y() * degreesPerPixel, -90.0, 90.0);
  }
}

void Camera::centreOn(const QVector3D& centre) {
  centre_ = centre;
  framed_ = false;
}

void Camera::lookFrom(double yaw, double pitch) {
  if (spatial_) {
    yaw_ = yaw;
    pitch_ = pitch;
  }
}

void Camera::lookFromAxis(int axis, bool positive) {
  const int above = up_ == Up::y ? 1 : 2;
  if (axis == above) {
    lookFrom(0, positive ? 90 : -90);
  } else if (axis == 0) {
    lookFrom(positive ? -90 : 90, 0);
  } else {
    const bool front = positive == (up_ == Up::y);  // +z, or -y if z is up
    lookFrom(front ? 0 : 180, 0);
  }
}

void Camera::pan(QPointF pixels, QSizeF view) {
  const QVector3D before = pointAt({0, 0}, centre_, view);
  const QVector3D after = pointAt(pixels, centre_, view);
  centre_ -= after - before;
  framed_ = false;
}

void Camera::zoom(double factor, QPointF cursor, QSizeF view) {
  const QVector3D before = pointAt(cursor, centre_, view);
  height_ = std::clamp(height_ / factor, radius_ * smallestHeight, radius_ * largestHeight);
  centre_ += before - pointAt(cursor, centre_, view);
  framed_ = false;
}

QMatrix4x4 Camera::toView() const {
  QMatrix4x4 matrix;
  matrix.translate(0, 0, float(-eyeDistance(height_)));
  matrix *= rotation();
  matrix.translate(-centre_);
  return matrix;
}

/// Returns the rotation from the axes of space to those of the view.
QMatrix4x4 Camera::rotation() const {
  QMatrix4x4 matrix;
  matrix.rotate(float(pitch_), 1, 0, 0);
  matrix.rotate(float(yaw_), 0, 1, 0);
  if (spatial_ && up_ == Up::z) {
    matrix.rotate(-90, 1, 0, 0);
  }
  return matrix;
}

QMatrix4x4 Camera::toClip(QSizeF view) const {
  const double aspect = view.width() / std::max(view.height(), 1.0);
  const double distance = eyeDistance(height_);
  const double reach = 8 * radius_;  // a dragged object may be far outside its box
  QMatrix4x4 matrix;
  if (spatial_ && !parallel_) {
    matrix.perspective(float(fieldOfView), float(aspect), float(std::max(distance - reach, distance * 0.02)),
                       float(distance + reach));
  } else {
    const auto halfHeight = float(height_ / 2), halfWidth = float(height_ / 2 * aspect);
    matrix.ortho(-halfWidth, halfWidth, -halfHeight, halfHeight, float(distance - reach), float(distance + reach));
  }
  return matrix;
}

double Camera::unitsPerPixel(QSizeF view) const { return height_ / std::max(view.height(), 1.0); }

std::array<double, 2> Camera::depthRange() const {
  const double distance = eyeDistance(height_);
  return {distance - radius_, distance + radius_};
}

QVector3D Camera::pointAt(QPointF position, const QVector3D& through, QSizeF view) const {
  const QMatrix4x4 matrix = toClip(view) * toView();
  // Projects `through` to find the depth of the plane, then maps the position at that depth back.
  const float depth = matrix.map(through).z();
  const QVector3D device(float(2 * position.x() / view.width() - 1), float(1 - 2 * position.y() / view.height()),
                         depth);
  return matrix.inverted().map(device);
}

}  // namespace chainmail

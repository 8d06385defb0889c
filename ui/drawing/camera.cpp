#include "drawing/camera.h"

#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

constexpr double fieldOfView = 35;  // degrees, vertical
constexpr double fitMargin = 1.25;  // height of the view, divided by the height of the fitted object
constexpr double degreesPerPixel = 0.4;
constexpr double smallestHeight = 1e-5, largestHeight = 1e3;  // visible height, in radii of the object

double eyeDistance(double height) { return height / 2 / std::tan(fieldOfView / 2 * M_PI / 180); }

}  // namespace

void Camera::fit(const std::array<Point, 2>& box, std::span<const int> axes, QSizeF view) {
  const auto carries = [axes](int k) { return std::find(axes.begin(), axes.end(), k) != axes.end(); };
  spatial_ = axes.size() == 3;
  // The camera looks at an xz plane from above and at a yz plane from the side.
  const bool fromAbove = !spatial_ && carries(2) && carries(0), fromSide = !spatial_ && carries(2) && !carries(0);
  yaw_ = spatial_ ? -30 : fromSide ? -90 : 0;
  pitch_ = spatial_ ? 25 : fromAbove ? 90 : 0;
  frame(box, view);
}

void Camera::frame(const std::array<Point, 2>& box, QSizeF view) {
  const Point centre = (box[0] + box[1]) / 2;
  const Point extent = box[1] - box[0];
  const double aspect = view.width() / std::max(view.height(), 1.0);
  centre_ = QVector3D(float(centre.x()), float(centre.y()), float(centre.z()));
  radius_ = std::max(extent.norm() / 2, 1e-9);
  const bool fromAbove = !spatial_ && pitch_ != 0, fromSide = !spatial_ && yaw_ != 0;
  const double across = fromSide ? extent.z() : extent.x(), up = fromAbove ? extent.z() : extent.y();
  const double flat = std::max(up, across / aspect);
  const double round = 2 * radius_ / std::min(aspect, 1.0) * 0.85;
  height_ = fitMargin * (spatial_ ? round : flat > 0 ? flat : 2 * radius_);
  framed_ = true;
}

void Camera::setPose(const Pose& pose) {
  centre_ = pose.centre;
  parallel_ = pose.parallel;
  framed_ = pose.framed;
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
  matrix.rotate(float(pitch_), 1, 0, 0);
  matrix.rotate(float(yaw_), 0, 1, 0);
  matrix.translate(-centre_);
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

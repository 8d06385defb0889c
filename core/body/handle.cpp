#include "body/handle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "mesh/error.h"

namespace chainmail {
namespace {

std::uint64_t new_grab() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

Eigen::Quaterniond quaternion_of(const Point& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)) : Eigen::Quaterniond::Identity();
}

std::string name_of(ElementId element) { return "element " + std::to_string(element); }

void check_handle(const Mesh& mesh, std::span<const ElementId> ascending) {
  if (ascending.empty()) {
    throw Error("handle", "it has no elements", "grab at least one element");
  }
  check_elements(mesh, ascending);
  if (const auto twice = std::ranges::adjacent_find(ascending); twice != ascending.end()) {
    throw Error(name_of(*twice), "it is grabbed twice", "name each element of the handle once");
  }
}

}  // namespace

Eigen::Matrix3d turn_of(const Point& rotation) {
  const double angle = rotation.norm();
  if (angle == 0) {
    return Eigen::Matrix3d::Zero();
  }
  const Point axis = rotation / angle;
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const double half = std::sin(angle / 2);
  return std::sin(angle) * cross + 2 * half * half * (cross * cross);  // 1 - cos, without cancellation
}

Eigen::Matrix3d turn_between(const Point& from, const Point& to) {
  // R R0⁻¹ − I, of the rotations R0 and R, is (turn − turn0) R0ᵀ.
  const Eigen::Matrix3d before = turn_of(from);
  return (turn_of(to) - before) * (before + Eigen::Matrix3d::Identity()).transpose();
}

Point rotation_between(const Point& from, const Point& to, double fraction) {
  if (fraction == 0 || from == to) {
    return from;
  }
  if (fraction == 1) {
    return to;
  }
  const Eigen::AngleAxisd between(quaternion_of(from).slerp(fraction, quaternion_of(to)));
  return between.angle() * between.axis();
}

double angle_between(const Point& from, const Point& to) {
  return quaternion_of(from).angularDistance(quaternion_of(to));
}

Point Rotation::vector() const {
  return degrees == 0 ? Point(Point::Zero()) : Point(axis.stableNormalized() * (degrees * (std::numbers::pi / 180)));
}

Rotation Rotation::of(const Point& vector) {
  const double angle = vector.norm();
  return angle == 0 ? Rotation() : Rotation{vector / angle, angle * (180 / std::numbers::pi)};
}

Rotation composed(const Rotation& first, const Rotation& then) {
  if (first.degrees == 0 || then.degrees == 0) {
    return first.degrees == 0 ? then : first;
  }
  if (first.axis == then.axis) {
    return {first.axis, first.degrees + then.degrees};
  }
  const Eigen::AngleAxisd both(quaternion_of(then.vector()) * quaternion_of(first.vector()));
  return {both.axis(), both.angle() * (180 / std::numbers::pi)};
}

void check(const Rotation& rotation, const Mesh& mesh) {
  if (rotation.degrees == 0) {
    return;
  }
  const double length = rotation.axis.stableNorm();
  if (!std::isfinite(rotation.degrees) || !std::isfinite(length)) {
    throw Error("rotation", "its angle or its axis is not a finite number", "give them as numbers");
  }
  if (!(length > 0)) {
    throw Error("rotation", "it has no axis: all its coordinates are 0", "give an axis such as 0, 0, 1");
  }
  for (int k = 0; k < 3 && mesh.space_dimension < 3; ++k) {
    const bool leaves_space = mesh.space_dimension == 1 || mesh.has_axis(k);
    if (rotation.axis[k] != 0 && leaves_space) {
      throw Error("rotation", std::string("about ") + "xyz"[k] + ", it would leave the space of the object",
                  mesh.space_dimension == 1
                      ? "move it without a rotation, or use more space dimensions"
                      : "rotate about the axis across the object's plane, or use more space dimensions");
    }
  }
}

RegionAxes axes_after(const Rotation& rotation, const Mesh& mesh) {
  RegionAxes axes(AxesKind::given, rotation.vector());
  check(axes, mesh);
  check(rotation, mesh);
  return axes;
}

void check_free(const Body& body, std::span<const ElementId> elements) {
  const auto pinned = std::ranges::find_if(elements, [&](ElementId one) { return body.is_pinned(one); });
  if (pinned != elements.end()) {
    throw Error(name_of(*pinned), "it is pinned and may not move", "unpin it, or grab another element");
  }
}

Handle::Handle(const Body& body, std::vector<ElementId> elements) : elements_(std::move(elements)) {
  std::ranges::sort(elements_);
  check_handle(body.mesh(), elements_);
  check_free(body, elements_);
  const PositionView positions = body.positions();
  for (const ElementId element : elements_) {
    positions_.push_back(point_of(body.mesh(), positions, element));
  }
  begin();
  pose_ = grabbed();
}

void Handle::begin() {
  for (const Point& position : positions_) {
    pivot_ += position / double(elements_.size());
  }
  grab_ = has_one() ? 0 : new_grab();
}

Handle Handle::in_axes(const RegionAxes& axes) const {
  Handle result = *this;
  for (Point& position : result.positions_) {
    position = axes.into_axes(position);
  }
  result.pivot_ = axes.into_axes(pivot_);
  result.pose_ = into_axes(axes, pose_);
  return result;
}

bool Handle::contains(ElementId element) const { return std::ranges::binary_search(elements_, element); }

}  // namespace chainmail

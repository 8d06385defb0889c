#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body.h"

namespace chainmail {

/// A rotation as a user gives it.
struct Rotation {
  Point axis = Point::Zero();  // of any length above 0, unless there is no rotation
  double degrees = 0;          // counterclockwise as seen from the tip of the axis

  /// The axis of length 1, times the angle (radians).
  Point vector() const;
  /// The rotation of such a vector; about no axis if its length is 0.
  static Rotation of(const Point& vector);
  bool operator==(const Rotation&) const = default;
};

/// Returns the rotation that `first`, then `then` make together. Rotations about the same axis add up without rounding
/// through the sphere of rotations: their angles may exceed a whole turn.
Rotation composed(const Rotation& first, const Rotation& then);

/// Where a handle is: the position of its pivot, and its rotation about the pivot since it was grabbed.
struct Pose {
  Point pivot = Point::Zero();     // mesh units
  Point rotation = Point::Zero();  // rotation vector: the axis times the angle (radians)

  bool operator==(const Pose&) const = default;
};

/// Return a pose in the coordinates of turned axes, and back.
inline Pose into_axes(const RegionAxes& axes, const Pose& pose) {
  return {axes.into_axes(pose.pivot), axes.into_axes(pose.rotation)};
}
inline Pose into_world(const RegionAxes& axes, const Pose& pose) {
  return {axes.into_world(pose.pivot), axes.into_world(pose.rotation)};
}

/// A rigid motion of a handle from where it was grabbed. It displaces a point at `arm` from the pivot by
/// turn · arm + translation.
struct RigidMotion {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();  // the rotation matrix less the identity
  Point translation = Point::Zero();               // mesh units

  Point of(const Point& arm) const { return turn * arm + translation; }
};

/// Returns the rotation matrix of a rotation vector, less the identity (Rodrigues). Exactly 0 for no rotation.
Eigen::Matrix3d turn_of(const Point& rotation);
/// Returns the rotation matrix from one rotation to another, less the identity. Exactly 0 if they are equal.
Eigen::Matrix3d turn_between(const Point& from, const Point& to);
/// Returns the rotation at a fraction of the shortest way from one rotation to another.
Point rotation_between(const Point& from, const Point& to, double fraction);
/// Returns the angle between two rotations (radians).
double angle_between(const Point& from, const Point& to);
/// Throws Error if an object with the mesh's axes cannot rotate like this, or if the rotation has no axis or is not
/// finite.
void check(const Rotation& rotation, const Mesh& mesh);

/// Returns the axes of the world after a rotation. Throws Error about the rotation as check() does.
RegionAxes axes_after(const Rotation& rotation, const Mesh& mesh);

/// Throws Error if one of these elements is pinned.
void check_free(const Body& body, std::span<const ElementId> elements);

/// What a user has grabbed: one element, or many that move together as one rigid body. Its pivot is the mean of the
/// positions at which they were grabbed.
class Handle {
 public:
  /// Grabs elements at their current positions. Throws Error if there is none, or if one does not exist, is given twice
  /// or is pinned.
  Handle(const Body& body, std::vector<ElementId> elements);
  /// The grabbed elements, ascending.
  std::span<const ElementId> elements() const { return elements_; }
  bool has_one() const { return elements_.size() == 1; }
  bool contains(ElementId element) const;
  /// The pose at which it was grabbed.
  Pose grabbed() const { return {pivot_, Point::Zero()}; }
  /// The pose that the last pass reached.
  const Pose& pose() const { return pose_; }
  void set_pose(const Pose& pose) { pose_ = pose; }
  /// A number of this grab: handles of many elements with the same number are copies of each other. 0 for a handle of
  /// one element: such handles are alike if their elements are.
  std::uint64_t grab() const { return grab_; }

  /// Returns the motion from the grab to a pose.
  RigidMotion motion(const Pose& pose) const { return {turn_of(pose.rotation), pose.pivot - pivot_}; }
  /// Position of element number i, from the pivot, when it was grabbed (mesh units).
  Point arm(std::size_t i) const { return positions_[i] - pivot_; }
  /// Returns the target of element number i for a motion (mesh units). Without a motion, this is exactly where it was
  /// grabbed. A handle of one element goes to the pivot of the pose instead, which needs no difference.
  Point target(std::size_t i, const RigidMotion& motion) const { return positions_[i] + motion.of(arm(i)); }
  /// Returns the same handle in the coordinates of turned axes.
  Handle in_axes(const RegionAxes& axes) const;

 private:
  void begin();

  std::vector<ElementId> elements_;
  std::vector<Point> positions_;  // when grabbed (mesh units)
  Point pivot_ = Point::Zero();
  Pose pose_;
  std::uint64_t grab_ = 0;
};

/// A move of a handle to a pose.
struct HandleMove {
  const Handle& handle;
  /// The target. A method that stops before it sets the pose that was reached.
  Pose pose;
};

}  // namespace chainmail

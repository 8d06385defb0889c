#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "mesh/mesh.h"

namespace chainmail {

/// Where the axes come from along which valid regions lie.
enum class FrameKind {
  axes,    // those of the world
  object,  // the principal axes of the object at rest
  given    // a rotation that the user gives
};

/// The kinds in the order of FrameKind, as files and the command line name them.
inline constexpr std::array<const char*, 3> frame_kinds{"axes", "object", "given"};

/// The axes along which valid regions lie: those of the world, turned. A body with such a frame keeps its positions in
/// the frame's coordinates, so that every algorithm works in it without knowing it.
class RegionFrame {
 public:
  /// The axes of the world.
  RegionFrame() = default;
  /// `rotation` turns the axes of the world into those of the frame: the axis times the angle (radians).
  RegionFrame(FrameKind kind, const Point& rotation);

  FrameKind kind() const { return kind_; }
  const Point& rotation() const { return rotation_; }
  bool is_turned() const { return rotation_ != Point::Zero(); }
  /// The axes as columns: turns a vector from the frame into the world. Exactly the identity if nothing is turned.
  const Eigen::Matrix3d& axes() const { return axes_; }

  Point into_frame(const Point& of_world) const { return axes_.transpose() * of_world; }
  Point into_world(const Point& of_frame) const { return axes_ * of_frame; }

  bool operator==(const RegionFrame& other) const { return kind_ == other.kind_ && rotation_ == other.rotation_; }

 private:
  FrameKind kind_ = FrameKind::axes;
  Point rotation_ = Point::Zero();
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
};

/// Turns the coordinates of one element, on the axes that exist, from the frame into the world or back.
void turn_into_world(const Mesh& mesh, const RegionFrame& frame, double* coordinates);
void turn_into_frame(const Mesh& mesh, const RegionFrame& frame, double* coordinates);

/// The principal axes of an object.
struct PrincipalAxes {
  RegionFrame frame;
  /// False if some of them do not exist, as for a cube, a sphere or a square bar: two of the spreads are equal. The
  /// frame then has the axes nearest to those of the world, and does not turn with the object.
  bool are_unique = true;
};

/// Returns the principal axes of the rest positions: the eigenvectors of their covariance, in the order and with the
/// signs in which they are nearest to the axes of the world.
PrincipalAxes principal_axes(const Mesh& mesh);

/// Returns the frame of this kind for another mesh: principal axes are found anew; a rotation that leaves the mesh's
/// space becomes none.
RegionFrame frame_for(const Mesh& mesh, const RegionFrame& frame);

/// Throws Error if the rotation is not finite or turns the axes out of the mesh's space.
void check(const RegionFrame& frame, const Mesh& mesh);

/// Returns the mesh with its rest positions in the coordinates of the frame; the same mesh if nothing is turned.
MeshPointer in_frame(const MeshPointer& mesh, const RegionFrame& frame);

}  // namespace chainmail

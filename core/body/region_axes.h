#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "mesh/mesh.h"

namespace chainmail {

/// Where the axes come from along which valid regions lie.
enum class AxesKind {
  axes,    // those of the world
  object,  // the principal axes of the object at rest
  given    // a rotation that the user gives
};

/// The kinds in the order of AxesKind, as files and the command line name them.
inline constexpr std::array<std::string_view, 3> axes_kinds{"axes", "object", "given"};

/// The axes along which valid regions lie: those of the world, turned. A body with turned axes keeps its positions in
/// their coordinates, so that every algorithm works in it without knowing it.
class RegionAxes {
 public:
  /// The axes of the world.
  RegionAxes() = default;
  /// `rotation` turns the axes of the world into these: the axis times the angle (radians).
  RegionAxes(AxesKind kind, const Point& rotation);

  AxesKind kind() const { return kind_; }
  const Point& rotation() const { return rotation_; }
  bool is_turned() const { return rotation_ != Point::Zero(); }
  /// The axes as columns: turns a vector from these axes into the world. Exactly the identity if nothing is turned.
  const Eigen::Matrix3d& matrix() const { return matrix_; }

  Point into_axes(const Point& of_world) const { return matrix_.transpose() * of_world; }
  Point into_world(const Point& along_axes) const { return matrix_ * along_axes; }

  bool operator==(const RegionAxes& other) const { return kind_ == other.kind_ && rotation_ == other.rotation_; }

 private:
  AxesKind kind_ = AxesKind::axes;
  Point rotation_ = Point::Zero();
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Identity();
};

/// Turns the coordinates of one element, on the axes that exist, from the axes into the world or back.
void turn_into_world(const Mesh& mesh, const RegionAxes& axes, double* coordinates);
void turn_into_axes(const Mesh& mesh, const RegionAxes& axes, double* coordinates);

/// The principal axes of an object.
struct PrincipalAxes {
  RegionAxes axes;
  /// False if some of them do not exist, as for a cube, a sphere or a square bar: two of the spreads are equal. The
  /// axes are then those nearest to those of the world, and do not turn with the object.
  bool are_unique = true;
};

/// Returns the principal axes of the rest positions: the eigenvectors of their covariance, in the order and with the
/// signs in which they are nearest to the axes of the world.
PrincipalAxes principal_axes(const Mesh& mesh);

/// Returns the axes of this kind for another mesh: principal axes are found anew; a rotation that leaves the mesh's
/// space becomes none.
RegionAxes axes_for(const Mesh& mesh, const RegionAxes& axes);

/// Throws Error if the rotation is not finite or turns the axes out of the mesh's space.
void check(const RegionAxes& axes, const Mesh& mesh);

/// Returns the mesh with its rest positions in the coordinates of the axes; the same mesh if nothing is turned.
MeshPointer in_axes(const MeshPointer& mesh, const RegionAxes& axes);

}  // namespace chainmail

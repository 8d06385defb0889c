#pragma once

#include <span>

#include "body/body.h"

namespace chainmail {

/// Where the coordinates of frames lie. Frames are in single precision, as graphics cards are, which is too coarse far
/// from the origin, and whose products overflow for extreme sizes. So the frames of such an object are about its middle
/// at rest, in a unit near its size. Those of all others are in mesh units about the origin.
class FrameSpace {
 public:
  FrameSpace() = default;
  explicit FrameSpace(const Mesh& mesh);

  /// Length of the unit of frames (mesh units), a power of two.
  double unit() const { return unit_; }
  bool is_of_mesh() const { return is_of_mesh_; }
  /// Returns the point of frames for a point of space (mesh units), and back.
  Point into(const Point& point) const { return (point - origin_) / unit_; }
  Point out_of(const Point& point) const { return origin_ + unit_ * point; }

  /// Copies the positions of elements from `first` on, space_dimension coordinates each.
  void copy(const Body& body, ElementId first, std::span<float> out) const { copy(body, first, unit_, out); }
  /// The same about the origin of frames, but in mesh units.
  void copy_about_origin(const Body& body, ElementId first, std::span<float> out) const { copy(body, first, 1, out); }
  /// Returns a view of such coordinates in mesh units, valid while they and this object are not changed.
  PositionView view(std::span<const float> coordinates) const;

  bool operator==(const FrameSpace& other) const { return origin_ == other.origin_ && unit_ == other.unit_; }

 private:
  /// Converts coordinates (mesh units), space_dimension for each point.
  void move(std::span<const double> coordinates, double unit, std::span<float> out) const;
  void copy(const Body& body, ElementId first, double unit, std::span<float> out) const;

  bool is_of_mesh_ = true;
  int dimension_ = 3;
  Point origin_ = Point::Zero();
  double unit_ = 1;
  std::array<double, 3> on_axes_{};  // the origin on the axes of the mesh
  AxisTurn scale_;
};

}  // namespace chainmail

#pragma once

#include <QLineF>
#include <QMatrix4x4>
#include <QRectF>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "drawing/mesh_level.h"
#include "simulate/frame.h"

namespace chainmail {

/// Bounding boxes of a level's clusters in the newest frame. A box is computed when it is asked for, and again only
/// after its cluster changed.
class ClusterBoxes {
 public:
  /// Lowest and highest coordinates on the axes of the mesh.
  struct Box {
    std::array<float, 3> lowest{}, highest{};
  };

  /// Turns to a frame of the level's mesh. It must stay until the last box of it was asked for.
  void follow(const MeshLevelPointer& level, const Frame& frame);
  /// Turns to a frame, and computes boxes ahead for some time. Returns true if all are computed.
  bool prepare(const MeshLevelPointer& level, const Frame& frame, std::chrono::milliseconds time);

  const MeshLevel& level() const { return *level_; }
  const Box& operator[](std::size_t cluster) const;

 private:
  bool isOutdated(std::size_t cluster) const;

  MeshLevelPointer level_;
  const Frame* frame_ = nullptr;
  std::uint64_t series_ = 0;
  std::optional<std::uint64_t> prepared_;  // number of the frame for which all boxes are computed
  mutable std::vector<Box> boxes_;
  mutable std::vector<std::uint64_t> seen_;  // per cluster: number of the frame that its box belongs to
};

/// Returns the matrix that maps the coordinates of frames on the axes of the mesh (1 to 3) to all three coordinates.
/// The other coordinates are constant.
QMatrix4x4 meshToWorld(const Mesh& mesh);

/// A rectangle in a view (logical pixels); empty by default.
struct ViewBounds {
  double left = std::numeric_limits<double>::max(), top = left;
  double right = std::numeric_limits<double>::lowest(), bottom = right;

  bool empty() const { return right < left; }
  static ViewBounds everywhere() {
    constexpr double far = 1e300;  // its products stay finite
    return {-far, -far, far, far};
  }
  void unite(const ViewBounds& other);
  bool meets(const QRectF& rectangle) const;
  bool meets(const QLineF& segment) const;
};

/// Projects elements to positions in a view (logical pixels) with depth.
class Projection {
 public:
  Projection(const Mesh& mesh, const QMatrix4x4& toView, const QMatrix4x4& toClip, QSizeF view);

  struct Place {
    float x, y;
    float distance;  // from the eye in perspective; 1 in parallel projection; at most 0 behind the eye
    float z;         // of the clip space
    bool visible() const { return distance > 0; }
  };
  /// Projects a point. `coordinates` points to its coordinates on the axes of the mesh.
  Place operator()(const float* coordinates) const;
  /// Returns the depth in pixels, which grows with the distance from the eye.
  float depth(const Place& place) const;
  /// Returns the number of pixels per mesh unit at this place, across the view and in depth.
  float pixelsPerUnit(const Place& place) const {
    return pixelsPerZ_ != 0 ? pixelsPerDepth_ : pixelsPerDepth_ / place.distance;
  }
  /// Returns one bit per side of the view, set if the whole box is beyond that side. Anything between two boxes is
  /// beyond the sides that are set for both, even if one of the boxes is behind the eye.
  unsigned beyond(const ClusterBoxes::Box& box) const;
  /// Returns the part of the view where the contents of a box may appear, with a margin for rounding: empty if the box
  /// is behind the eye, everywhere() if only a part of it is.
  ViewBounds bounds(const ClusterBoxes::Box& box) const;

 private:
  std::array<double, 4> clipped(const ClusterBoxes::Box& box, int corner) const;

  QMatrix4x4 matrix_;
  int dimension_;
  QSizeF view_;
  float pixelsPerDepth_;
  float pixelsPerZ_;  // in parallel projection, else 0
};

}  // namespace chainmail

#pragma once

#include <QLineF>
#include <QMatrix4x4>
#include <QRectF>
#include <limits>

#include "drawing/cluster_boxes.h"

namespace chainmail {

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

#pragma once

#include <QLineF>
#include <QMatrix4x4>
#include <QRectF>
#include <limits>

#include "drawing/cluster_boxes.h"

namespace chainmail {

/// Returns the matrix from the coordinates that the mesh has (1 to 3) to all three of space; the others are constant.
QMatrix4x4 placement(const Mesh& mesh);

/// Bounds of something in a view (logical pixels).
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
  /// `carried` points to the coordinates that the mesh has.
  Place operator()(const float* carried) const;
  /// Returns the depth in pixels, which grows away from the eye.
  float depth(const Place& place) const;
  /// Returns the number of pixels per mesh unit there, across the view and in depth.
  float pixelsPerUnit(const Place& place) const {
    return pixelsPerZ_ != 0 ? pixelsPerDepth_ : pixelsPerDepth_ / place.distance;
  }
  /// Returns the sides of the view, as bits, beyond which the whole box is. Anything between two boxes is beyond the
  /// sides that they have in common, even if one of them is behind the eye.
  unsigned beyond(const ClusterBoxes::Box& box) const;
  /// Returns where the contents of a box appear, rounding included: nowhere if the box is behind the eye, everywhere if
  /// a part of it is.
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

#pragma once

#include <QLineF>
#include <QMatrix4x4>
#include <QRectF>
#include <limits>

#include "drawing/cell_boxes.h"

namespace chainmail {

/// Carried coordinates to the three of space: the axes in their places, the others constant.
QMatrix4x4 placement(const Mesh& mesh);

/// A part of a view outside which something does not appear (logical pixels).
struct ViewBounds {
  double left = std::numeric_limits<double>::max(), top = left;
  double right = std::numeric_limits<double>::lowest(), bottom = right;

  bool empty() const { return right < left; }
  static ViewBounds everywhere() {
    constexpr double far = 1e300;  // products with it stay finite
    return {-far, -far, far, far};
  }
  void unite(const ViewBounds& other);
  bool meets(const QRectF& rectangle) const;
  bool meets(const QLineF& segment) const;
};

/// Where elements appear in a view (logical pixels), and how deep.
class Projection {
 public:
  Projection(const Mesh& mesh, const QMatrix4x4& toView, const QMatrix4x4& toClip, QSizeF view);

  struct Place {
    float x, y;
    float distance;  // from the eye in perspective, 1 by parallel rays, 0 or less behind the eye
    float z;         // as the projection has it
    bool visible() const { return distance > 0; }
  };
  /// `carried` points to the coordinates that the scene carries.
  Place operator()(const float* carried) const;
  /// Depth in pixels, growing away from the eye.
  float depth(const Place& place) const;
  /// How many pixels a mesh unit spans there, across the view and in depth.
  float pixelsPerUnit(const Place& place) const {
    return pixelsPerZ_ != 0 ? pixelsPerDepth_ : pixelsPerDepth_ / place.distance;
  }
  /// Sides of the view, as bits, beyond which all of a box lies. What lies between two boxes is beyond those that they
  /// have in common, where one of them is behind the eye too.
  unsigned beyond(const CellBoxes::Box& box) const;
  /// Where all that lies in a box appears, rounding included: nowhere if it is behind the eye, everywhere if a part is.
  ViewBounds bounds(const CellBoxes::Box& box) const;

 private:
  std::array<double, 4> clipped(const CellBoxes::Box& box, int corner) const;

  QMatrix4x4 matrix_;
  int dimension_;
  QSizeF view_;
  float pixelsPerDepth_;
  float pixelsPerZ_;  // by parallel rays, else 0
};

}  // namespace chainmail

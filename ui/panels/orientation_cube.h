#pragma once

#include <QPolygonF>
#include <QSizeF>
#include <array>
#include <optional>
#include <vector>

#include "drawing/camera.h"

class QPainter;

namespace chainmail {

/// A small cube in the top right corner of a view in 3D. It shows the directions of the axes; a click on a face looks
/// at the object from there.
class OrientationCube {
 public:
  /// A visible face: the axis it is perpendicular to, its end of that axis, and its corners in the view (logical
  /// pixels).
  struct Face {
    int axis = 0;
    bool positive = true;
    QPolygonF corners;
    float towardsViewer = 0;  // 1 if it is seen from the front, 0 edge-on
  };

  OrientationCube(const Camera& camera, QSizeF view);

  /// Returns the face at a position in the view, if there is one.
  std::optional<Face> faceAt(QPointF position) const;
  void draw(QPainter& painter) const;

 private:
  std::vector<Face> faces_;
};

}  // namespace chainmail

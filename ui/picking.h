#pragma once

#include <QLineF>
#include <QMatrix4x4>
#include <QPointF>
#include <QSizeF>
#include <functional>
#include <optional>
#include <vector>

#include "mesh/cuts.h"
#include "simulate/frame.h"

namespace chainmail {

/// Carried coordinates to the three of space: the axes in their places, the others constant.
QMatrix4x4 placement(const Mesh& mesh);

/// Where elements appear in a view (logical pixels), and how deep.
class Projection {
 public:
  Projection(const Mesh& mesh, const QMatrix4x4& toView, const QMatrix4x4& toClip, QSizeF view);

  struct Place {
    float x, y;
    float distance;  // from the eye in perspective, 1 in a plane view, 0 or less behind the eye
    bool visible() const { return distance > 0; }
  };
  /// `carried` points to the coordinates that the scene carries.
  Place operator()(const float* carried) const;
  /// Depth in pixels, growing away from the eye.
  float depth(const Place& place) const;

 private:
  QMatrix4x4 matrix_;
  int dimension_;
  QSizeF view_;
  float pixelsPerDepth_;
};

/// The element nearest to a place of the view within `reach` pixels, where one in front is preferred to
/// one behind.
std::optional<ElementId> nearestElement(const Frame& frame, const Projection& projection, QPointF place, double reach);

/// The elements, ascending, that appear at places for which `inside` holds, those behind others too.
std::vector<ElementId> elementsWhere(const Frame& frame, const Projection& projection,
                                     const std::function<bool(QPointF)>& inside);

/// The distance of a place from a segment, which may be a point (pixels).
double distanceFrom(QLineF segment, QPointF place);

/// The links, not yet cut, that a stroke crosses in the view.
std::vector<LinkId> crossedLinks(const Frame& frame, const Cuts& cuts, const Projection& projection, QLineF stroke);

}  // namespace chainmail

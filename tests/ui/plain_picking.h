#pragma once

#include <algorithm>
#include <cmath>

#include "drawing/picking.h"

/// The simplest implementation of picking, which looks at every element and link. The fast one must give the same
/// results.
namespace chainmail::plain {

inline Projection::Place viewPosition(const Frame& frame, const Projection& projection, ElementId e) {
  return projection(frame.positions.data() + std::size_t{e} * frame.mesh->space_dimension);
}

inline std::optional<ElementId> nearestElement(const Frame& frame, const Projection& projection, QPointF place,
                                               double reach) {
  std::optional<ElementId> best;
  float bestScore = 0;
  for (ElementId e = 0; e < frame.mesh->element_count(); ++e) {
    const auto at = viewPosition(frame, projection, e);
    const float dx = at.x - float(place.x()), dy = at.y - float(place.y());
    if (!(dx * dx + dy * dy <= float(reach * reach)) || !at.visible()) {
      continue;
    }
    const float score = std::hypot(dx, dy) + 0.15F * projection.depth(at);
    if (!best || score < bestScore) {
      best = e;
      bestScore = score;
    }
  }
  return best;
}

inline std::vector<ElementId> elementsIn(const Frame& frame, const Projection& projection, const QRectF& rectangle) {
  std::vector<ElementId> found;
  for (ElementId e = 0; e < frame.mesh->element_count(); ++e) {
    const auto at = viewPosition(frame, projection, e);
    if (at.visible() && rectangle.contains(QPointF(at.x, at.y))) {
      found.push_back(e);
    }
  }
  return found;
}

/// Returns the links that the stroke crosses, found with Qt's own intersection. Only parallel and touching segments may
/// give another result.
inline std::vector<LinkId> crossedLinks(const Frame& frame, const Cuts& cuts, const Projection& projection,
                                        QLineF stroke) {
  std::vector<LinkId> crossed;
  for (LinkId link = 0; link < frame.mesh->link_count(); ++link) {
    const auto a = viewPosition(frame, projection, frame.mesh->links[link][0]);
    const auto b = viewPosition(frame, projection, frame.mesh->links[link][1]);
    if (a.visible() && b.visible() && !cuts.is_cut(link) &&
        stroke.intersects(QLineF(a.x, a.y, b.x, b.y)) == QLineF::BoundedIntersection) {
      crossed.push_back(link);
    }
  }
  return crossed;
}

}  // namespace chainmail::plain

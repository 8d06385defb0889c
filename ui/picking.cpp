#include "picking.h"

#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

// A pixel of depth weighs this much against a pixel of distance from the cursor.
constexpr float depthWeight = 0.15F;

/// Which side of the line a point lies on: twice the area of the triangle they span.
double side(QLineF line, QPointF point) {
  return line.dx() * (point.y() - line.y1()) - line.dy() * (point.x() - line.x1());
}

/// Whether two segments have a point in common. Most do not come near each other: that is seen first, and
/// it is what tells apart two segments on one line.
bool cross(QLineF a, QLineF b) {
  const auto apart = [](double p, double q, double r, double s) {
    return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
  };
  if (apart(a.x1(), a.x2(), b.x1(), b.x2()) || apart(a.y1(), a.y2(), b.y1(), b.y2())) {
    return false;
  }
  return side(a, b.p1()) * side(a, b.p2()) <= 0 && side(b, a.p1()) * side(b, a.p2()) <= 0 && !a.isNull() && !b.isNull();
}

}  // namespace

QMatrix4x4 placement(const Mesh& mesh) {
  QMatrix4x4 matrix;
  matrix.fill(0);
  matrix(3, 3) = 1;
  for (int k = 0; k < 3; ++k) {
    matrix(k, 3) = float(mesh.origin[k]);
  }
  for (int k = 0; k < mesh.space_dimension; ++k) {
    matrix(mesh.axes[k], k) = 1;
    matrix(mesh.axes[k], 3) = 0;
  }
  return matrix;
}

Projection::Projection(const Mesh& mesh, const QMatrix4x4& toView, const QMatrix4x4& toClip, QSizeF view)
    : matrix_(toClip * toView * placement(mesh)), dimension_(mesh.space_dimension), view_(view) {
  // One unit along the view's vertical spans this many pixels at the depth of the origin of the view.
  pixelsPerDepth_ = float(toClip(1, 1) * view.height() / 2);
}

Projection::Place Projection::operator()(const float* carried) const {
  const float* m = matrix_.constData();  // column by column
  float clip[4]{m[12], m[13], m[14], m[15]};
  for (int k = 0; k < dimension_; ++k) {
    for (int row = 0; row < 4; ++row) {
      clip[row] += m[4 * k + row] * carried[k];
    }
  }
  const float w = clip[3];
  return {(clip[0] / w + 1) / 2 * float(view_.width()), (1 - clip[1] / w) / 2 * float(view_.height()), w};
}

float Projection::depth(const Place& place) const {
  // At a distance w from the eye a unit of depth spans pixelsPerDepth_ / w pixels.
  return pixelsPerDepth_ * std::log(place.distance);
}

std::optional<ElementId> nearestElement(const Frame& frame, const Projection& projection, QPointF place, double reach) {
  const int dimension = frame.mesh->space_dimension;
  std::optional<ElementId> best;
  float bestScore = 0;
  for (ElementId e = 0; e < frame.mesh->element_count(); ++e) {
    const auto at = projection(frame.positions.data() + std::size_t{e} * dimension);
    const float dx = at.x - float(place.x()), dy = at.y - float(place.y());
    if (!(dx * dx + dy * dy <= float(reach * reach)) || !at.visible()) {
      continue;
    }
    const float score = std::hypot(dx, dy) + depthWeight * projection.depth(at);
    if (!best || score < bestScore) {
      best = e;
      bestScore = score;
    }
  }
  return best;
}

std::vector<ElementId> elementsWhere(const Frame& frame, const Projection& projection,
                                     const std::function<bool(QPointF)>& inside) {
  std::vector<ElementId> found;
  for (ElementId e = 0; e < frame.mesh->element_count(); ++e) {
    const auto at = projection(frame.positions.data() + std::size_t{e} * frame.mesh->space_dimension);
    if (at.visible() && inside(QPointF(at.x, at.y))) {
      found.push_back(e);
    }
  }
  return found;
}

double distanceFrom(QLineF segment, QPointF place) {
  const QPointF along = segment.p2() - segment.p1(), from = place - segment.p1();
  const double squared = QPointF::dotProduct(along, along);
  const double share = squared > 0 ? std::clamp(QPointF::dotProduct(from, along) / squared, 0.0, 1.0) : 0;
  return QLineF(segment.p1() + share * along, place).length();
}

std::vector<LinkId> crossedLinks(const Frame& frame, const Cuts& cuts, const Projection& projection, QLineF stroke) {
  const Mesh& mesh = *frame.mesh;
  std::vector<Projection::Place> places(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    places[e] = projection(frame.positions.data() + std::size_t{e} * mesh.space_dimension);
  }
  std::vector<LinkId> crossed;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const auto& a = places[mesh.links[link][0]];
    const auto& b = places[mesh.links[link][1]];
    if (a.visible() && b.visible() && cross(stroke, QLineF(a.x, a.y, b.x, b.y)) && !cuts.is_cut(link)) {
      crossed.push_back(link);
    }
  }
  return crossed;
}

}  // namespace chainmail

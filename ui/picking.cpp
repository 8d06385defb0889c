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

bool cross(QLineF a, QLineF b) {
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
  // In perspective w is the distance from the eye, in a plane view it is 1 and all are equally deep.
  return {(clip[0] / w + 1) / 2 * float(view_.width()), (1 - clip[1] / w) / 2 * float(view_.height()),
          pixelsPerDepth_ * std::log(std::max(w, 1e-30F)), w > 0};
}

std::optional<ElementId> nearestElement(const Frame& frame, const Projection& projection, QPointF place, double reach) {
  const int dimension = frame.mesh->space_dimension;
  std::optional<ElementId> best;
  float bestScore = 0;
  for (ElementId e = 0; e < frame.mesh->element_count(); ++e) {
    const auto at = projection(frame.positions.data() + std::size_t{e} * dimension);
    const float distance = std::hypot(at.x - float(place.x()), at.y - float(place.y()));
    const float score = distance + depthWeight * at.depth;
    if (at.visible && distance <= float(reach) && (!best || score < bestScore)) {
      best = e;
      bestScore = score;
    }
  }
  return best;
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
    if (a.visible && b.visible && cross(stroke, QLineF(a.x, a.y, b.x, b.y)) && !cuts.is_cut(link)) {
      crossed.push_back(link);
    }
  }
  return crossed;
}

}  // namespace chainmail

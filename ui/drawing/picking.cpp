#include "drawing/picking.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace chainmail {
namespace {

// Weight of a pixel of depth, relative to a pixel of distance from the cursor.
constexpr float depthWeight = 0.15F;

/// Returns twice the signed area of the triangle of line and point. The sign says on which side of the line the point
/// is.
double side(QLineF line, QPointF point) {
  return line.dx() * (point.y() - line.y1()) - line.dy() * (point.x() - line.x1());
}

/// True if two segments have a point in common. Compares the bounds first, because most segments are far apart, and
/// because only the bounds separate two segments on one line.
bool segmentsCross(QLineF a, QLineF b) {
  const auto apart = [](double p, double q, double r, double s) {
    return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
  };
  if (apart(a.x1(), a.x2(), b.x1(), b.x2()) || apart(a.y1(), a.y2(), b.y1(), b.y2())) {
    return false;
  }
  return side(a, b.p1()) * side(a, b.p2()) <= 0 && side(b, a.p1()) * side(b, a.p2()) <= 0 && !a.isNull() && !b.isNull();
}

/// Returns the part of the view where links between two clusters may appear: everywhere if they extend from in front of
/// the eye to behind it.
ViewBounds united(ViewBounds a, const ViewBounds& b) {
  if (a.empty() != b.empty()) {
    return ViewBounds::everywhere();
  }
  a.unite(b);
  return a;
}

std::vector<ViewBounds> clusterBounds(const ClusterBoxes& boxes, const Projection& projection) {
  std::vector<ViewBounds> bounds(boxes.level().clusterCount());
  for (std::size_t cluster = 0; cluster < bounds.size(); ++cluster) {
    bounds[cluster] = projection.bounds(boxes[cluster]);
  }
  return bounds;
}

}  // namespace

std::optional<ElementId> nearestElement(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                        QPointF position, double reach, const std::function<bool(ElementId)>& shown) {
  const int dimension = frame.mesh->space_dimension;
  const QRectF within(position - QPointF(reach, reach), position + QPointF(reach, reach));
  std::optional<ElementId> best;
  float bestScore = 0;
  for (std::size_t cluster = 0; cluster < boxes.level().clusterCount(); ++cluster) {
    if (!projection.bounds(boxes[cluster]).meets(within)) {
      continue;
    }
    for (const ElementId e : boxes.level().clusters[cluster]) {
      const auto at = projection(frame.positions.data() + std::size_t{e} * dimension);
      const float dx = at.x - float(position.x()), dy = at.y - float(position.y());
      if (!(dx * dx + dy * dy <= float(reach * reach)) || !at.visible() || (shown && !shown(e))) {
        continue;
      }
      const float score = std::hypot(dx, dy) + depthWeight * projection.depth(at);
      // Of two equal scores, the lower id wins, so that the order of the clusters has no effect.
      if (!best || score < bestScore || (score == bestScore && e < *best)) {
        best = e;
        bestScore = score;
      }
    }
  }
  return best;
}

std::vector<ElementId> elementsWhere(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                     QRectF bounds, const std::function<bool(QPointF)>& inside,
                                     const std::function<bool(ElementId)>& shown) {
  std::vector<ElementId> found;
  for (std::size_t cluster = 0; cluster < boxes.level().clusterCount(); ++cluster) {
    if (!projection.bounds(boxes[cluster]).meets(bounds)) {
      continue;
    }
    for (const ElementId e : boxes.level().clusters[cluster]) {
      const auto at = projection(frame.positions.data() + std::size_t{e} * frame.mesh->space_dimension);
      if (at.visible() && inside(QPointF(at.x, at.y)) && (!shown || shown(e))) {
        found.push_back(e);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

double distanceFrom(QLineF segment, QPointF position) {
  const QPointF along = segment.p2() - segment.p1(), from = position - segment.p1();
  const double squared = QPointF::dotProduct(along, along);
  const double share = squared > 0 ? std::clamp(QPointF::dotProduct(from, along) / squared, 0.0, 1.0) : 0;
  return QLineF(segment.p1() + share * along, position).length();
}

std::vector<std::uint32_t> clustersSeen(const ClusterBoxes& boxes, const Projection& projection) {
  const MeshLevel& level = boxes.level();
  std::vector<unsigned> beyond(level.clusterCount());
  for (std::size_t cluster = 0; cluster < beyond.size(); ++cluster) {
    beyond[cluster] = projection.beyond(boxes[cluster]);
  }
  std::vector<std::uint32_t> seen;
  for (std::uint32_t cluster = 0; cluster < beyond.size(); ++cluster) {
    const auto isSeen = [&](std::uint32_t other) { return (beyond[cluster] & beyond[other]) == 0; };
    if (isSeen(cluster) || std::ranges::any_of(level.reached[cluster], isSeen)) {
      seen.push_back(cluster);
    }
  }
  return seen;
}

std::vector<LinkId> crossedLinks(const Frame& frame, const ClusterBoxes& boxes, const Cuts& cuts,
                                 const Projection& projection, QLineF stroke) {
  const MeshLevel& level = boxes.level();
  // Has room for all elements. Only elements in clusters near the stroke are filled in.
  const auto places = std::make_unique_for_overwrite<Projection::Place[]>(level.mesh->element_count());
  std::vector<bool> placed(level.clusterCount());
  const auto projectCluster = [&](std::size_t cluster) {
    if (!placed[cluster]) {
      for (const ElementId e : level.clusters[cluster]) {
        places[e] = projection(frame.positions.data() + std::size_t{e} * level.mesh->space_dimension);
      }
      placed[cluster] = true;
    }
  };
  const auto bounds = clusterBounds(boxes, projection);
  std::vector<LinkId> crossed;
  for (std::size_t cluster = 0; cluster < bounds.size(); ++cluster) {
    for (std::uint32_t i = level.reached.first[cluster]; i < level.reached.first[cluster + 1]; ++i) {
      const std::uint32_t other = level.reached.items[i];
      if (!united(bounds[cluster], bounds[other]).meets(stroke)) {
        continue;
      }
      projectCluster(cluster);
      projectCluster(other);
      for (std::uint32_t at = level.reachedLinks[i]; at < level.reachedLinks[i + 1]; ++at) {
        const LinkId link = level.clusterLinks.items[at];
        const auto &a = places[level.links[link][0]], &b = places[level.links[link][1]];
        if (a.visible() && b.visible() && segmentsCross(stroke, QLineF(a.x, a.y, b.x, b.y)) && !cuts.is_cut(link)) {
          crossed.push_back(link);
        }
      }
    }
  }
  std::sort(crossed.begin(), crossed.end());
  return crossed;
}

}  // namespace chainmail

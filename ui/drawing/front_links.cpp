#include "drawing/front_links.h"

#include <algorithm>

#include "mesh/cells.h"

namespace chainmail {
/// A position in the view, with a depth that grows with the distance from the eye and is linear along straight lines in
/// the view.
struct Spot {
  QPointF at;
  double depth = 0;
};

namespace {

// Rounding error of depths, which are between -1 and 1. With it, a point on a face does not count as behind the face.
constexpr double depthRounding = 1e-6;
// In mean link lengths. In an object without faces, the nearest element within this distance belongs to the front
// layer. Links that are further behind it than this belong to the next layer. In a grid, every position has an element
// within 0.71.
constexpr double layerThickness = 0.75;

Projection::Place project(const Frame& frame, const Projection& projection, ElementId element) {
  return projection(frame.positions.data() + std::size_t{element} * frame.mesh->space_dimension);
}

Spot spotOf(const Projection::Place& place) { return {{place.x, place.y}, double(place.z) / double(place.distance)}; }

double crossProduct(QPointF a, QPointF b) { return a.x() * b.y() - a.y() * b.x(); }

/// Returns the point where the stroke crosses a link, as a fraction of the way from `a` to `b` (0 to 1).
double shareAt(QLineF stroke, QPointF a, QPointF b) {
  const QPointF along = stroke.p2() - stroke.p1();
  const double before = crossProduct(along, a - stroke.p1()), after = crossProduct(along, b - stroke.p1());
  return before == after ? 0.5 : std::clamp(before / (before - after), 0.0, 1.0);
}

Spot between(const Spot& a, const Spot& b, double share) {
  return {a.at + share * (b.at - a.at), a.depth + share * (b.depth - a.depth)};
}

QRectF boundsOf(std::span<const Spot> spots) {
  QRectF bounds(spots[0].at, spots[0].at);
  for (const Spot& spot : spots) {
    bounds.setLeft(std::min(bounds.left(), spot.at.x()));
    bounds.setRight(std::max(bounds.right(), spot.at.x()));
    bounds.setTop(std::min(bounds.top(), spot.at.y()));
    bounds.setBottom(std::max(bounds.bottom(), spot.at.y()));
  }
  return bounds;
}

/// Same as QRectF::intersects, but also for rectangles without area.
bool meet(const QRectF& a, const QRectF& b) {
  return a.left() <= b.right() && b.left() <= a.right() && a.top() <= b.bottom() && b.top() <= a.bottom();
}

}  // namespace

struct SeenFace {
  Face corners;
  std::array<Spot, 3> spots;

  bool has(ElementId element) const { return std::ranges::find(corners, element) != corners.end(); }
  /// True if the face covers this spot and is nearer to the eye.
  bool hides(const Spot& spot) const {
    const auto depth = depthAt(spot.at);
    return depth && *depth < spot.depth - depthRounding;
  }
  /// Returns the depth of the face at a position, if the face covers it.
  std::optional<double> depthAt(QPointF at) const {
    const auto& [a, b, c] = spots;
    const double all = crossProduct(b.at - a.at, c.at - a.at);
    const double ofB = crossProduct(at - a.at, c.at - a.at) / all, ofC = crossProduct(b.at - a.at, at - a.at) / all;
    if (!(ofB >= 0 && ofC >= 0 && ofB + ofC <= 1)) {
      return std::nullopt;  // also (NaN) for a face that is seen edge-on
    }
    return a.depth + ofB * (b.depth - a.depth) + ofC * (c.depth - a.depth);
  }
};

namespace {

std::vector<SeenFace> facesAt(const Frame& frame, const Projection& projection, std::span<const Face> faces,
                              const QRectF& part) {
  std::vector<SeenFace> seen;
  for (const Face& face : faces) {
    SeenFace one{face, {}};
    bool visible = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto place = project(frame, projection, face[k]);
      visible = visible && place.visible();
      one.spots[k] = spotOf(place);
    }
    if (visible && meet(boundsOf(one.spots), part)) {
      seen.push_back(one);
    }
  }
  return seen;
}

/// Returns, for each cluster, the part of the view where its faces may appear. Faces extend to the clusters that the
/// cluster reaches.
std::vector<ViewBounds> faceBounds(const ClusterBoxes& boxes, const Projection& projection) {
  const MeshLevel& level = boxes.level();
  std::vector<ViewBounds> own(level.clusterCount());
  for (std::size_t cluster = 0; cluster < own.size(); ++cluster) {
    own[cluster] = projection.bounds(boxes[cluster]);
  }
  std::vector<ViewBounds> bounds = own;
  for (std::size_t cluster = 0; cluster < own.size(); ++cluster) {
    for (const std::uint32_t other : level.reached[cluster]) {
      if (own[cluster].empty() != own[other].empty()) {
        bounds[cluster] = ViewBounds::everywhere();  // the faces extend from in front of the eye to behind it
      }
      bounds[cluster].unite(own[other]);
    }
  }
  return bounds;
}

/// The point where a link crosses a stroke, and its depth (pixels).
struct Crossing {
  QPointF at;
  double depth = 0;
  double radius = 0;  // of the neighbourhood to search
};

Crossing crossingOf(const Frame& frame, const Projection& projection, QLineF stroke, LinkId link) {
  const auto a = project(frame, projection, frame.mesh->links[link][0]);
  const auto b = project(frame, projection, frame.mesh->links[link][1]);
  const QPointF first(a.x, a.y), second(b.x, b.y);
  const double share = shareAt(stroke, first, second);
  const double perUnit = std::max(projection.pixelsPerUnit(a), projection.pixelsPerUnit(b));
  return {first + share * (second - first),
          projection.depth(a) + share * double(projection.depth(b) - projection.depth(a)),
          layerThickness * frame.mesh->mean_link_length * perUnit};
}

/// Returns the elements within `about` pixels of the bounds of a stroke, with their depths in pixels.
std::vector<Spot> elementsAbout(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                QLineF stroke, double about) {
  const QRectF bounds = QRectF(stroke.p1(), stroke.p2()).normalized().adjusted(-about, -about, about, about);
  std::vector<Spot> spots;
  for (const ElementId element :
       elementsWhere(frame, boxes, projection, bounds, [&](QPointF at) { return bounds.contains(at); })) {
    const auto place = project(frame, projection, element);
    spots.push_back({{place.x, place.y}, projection.depth(place)});
  }
  return spots;
}

}  // namespace

FrontFaces::FrontFaces(const Frame& frame, const Projection& projection, std::span<const Face> faces, QRectF part)
    : frame_(frame), projection_(projection), faces_(facesAt(frame, projection, faces, part)) {}

FrontFaces::~FrontFaces() = default;

bool FrontFaces::hides(ElementId element) const {
  const Spot spot = spotOf(project(frame_, projection_, element));
  return std::ranges::any_of(faces_, [&](const SeenFace& face) { return !face.has(element) && face.hides(spot); });
}

std::optional<ElementId> FrontFaces::cornerAt(QPointF position, const std::function<bool(ElementId)>& shown) const {
  const SeenFace* front = nullptr;
  double least = 0;
  for (const SeenFace& face : faces_) {
    if (const auto depth = face.depthAt(position); depth && (front == nullptr || *depth < least)) {
      front = &face;
      least = *depth;
    }
  }
  std::optional<ElementId> nearest;
  double distance = 0;
  for (std::size_t k = 0; front != nullptr && k < 3; ++k) {
    const double to = QLineF(position, front->spots[k].at).length();
    if ((!shown || shown(front->corners[k])) && (!nearest || to < distance)) {
      nearest = front->corners[k];
      distance = to;
    }
  }
  return nearest;
}

std::vector<Face> wholeFaces(const Frame& frame, const ClusterBoxes& boxes, const Cuts& cuts,
                             const Projection& projection, QRectF part) {
  const MeshLevel& level = boxes.level();
  std::vector<Face> faces;
  const auto bounds = faceBounds(boxes, projection);
  for (std::size_t cluster = 0; cluster < level.clusterCount(); ++cluster) {
    if (!bounds[cluster].meets(part)) {
      continue;
    }
    for (const std::uint32_t face : level.clusterFaces[cluster]) {
      const auto& [a, b, c] = level.faces[face];
      if (!is_cut_between(*frame.mesh, cuts, a, b) && !is_cut_between(*frame.mesh, cuts, b, c) &&
          !is_cut_between(*frame.mesh, cuts, c, a)) {
        faces.push_back(level.faces[face]);
      }
    }
  }
  return faces;
}

void appendFaces(const Surface& surface, std::vector<Face>& faces) {
  const std::vector<ElementId> corners = surface.triangles();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
}

std::vector<LinkId> unhiddenLinks(const Frame& frame, const Projection& projection, QLineF stroke,
                                  std::span<const LinkId> crossed, std::span<const Face> faces) {
  const auto seen = facesAt(frame, projection, faces, QRectF(stroke.p1(), stroke.p2()).normalized());
  std::vector<LinkId> unhidden;
  for (const LinkId link : crossed) {
    const auto [a, b] = frame.mesh->links[link];
    const Spot first = spotOf(project(frame, projection, a)), second = spotOf(project(frame, projection, b));
    const Spot spot = between(first, second, shareAt(stroke, first.at, second.at));
    const auto hides = [&, a = a, b = b](const SeenFace& f) { return !(f.has(a) && f.has(b)) && f.hides(spot); };
    if (std::ranges::none_of(seen, hides)) {
      unhidden.push_back(link);
    }
  }
  return unhidden;
}

std::vector<LinkId> nearestLinks(const Frame& frame, const ClusterBoxes& boxes, const Projection& projection,
                                 QLineF stroke, std::span<const LinkId> crossed) {
  std::vector<Crossing> crossings;
  double about = 0;
  for (const LinkId link : crossed) {
    crossings.push_back(crossingOf(frame, projection, stroke, link));
    about = std::max(about, crossings.back().radius);
  }
  const auto spots = elementsAbout(frame, boxes, projection, stroke, about);
  std::vector<LinkId> nearest;
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    const Crossing& crossing = crossings[i];
    const bool behind = std::ranges::any_of(spots, [&](const Spot& spot) {
      return spot.depth < crossing.depth - crossing.radius && QLineF(crossing.at, spot.at).length() <= crossing.radius;
    });
    if (!behind) {
      nearest.push_back(crossed[i]);
    }
  }
  return nearest;
}

}  // namespace chainmail

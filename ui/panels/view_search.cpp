#include "panels/view_search.h"

#include <algorithm>

#include "drawing/front_links.h"
#include "drawing/object_drawing.h"
#include "mesh/split_along.h"
#include "mesh/surface.h"

namespace chainmail {
namespace {

constexpr double elementReach = 14;  // pixels, largest distance from the cursor at which an element is found

}  // namespace

const ClusterBoxes& ViewSearch::boxes(const Frame& frame) const {
  boxes_.follow(levels_->at(frame.mesh, 1), frame);
  return boxes_;
}

bool ViewSearch::prepare(const Frame& frame, std::chrono::milliseconds time) const {
  return boxes_.prepare(levels_->at(frame.mesh, 1), frame, time);
}

Projection ViewSearch::projection() const {
  return {*document_.mesh(), camera_->toView(), camera_->toClip(view_.size()), view_.size()};
}

std::function<bool(ElementId)> ViewSearch::shown() const {
  if (!options_.section) {
    return {};
  }
  return [mesh = document_.mesh(), plane = *options_.section](ElementId element) {
    return !(plane.before(mesh->rest_position(element)) > 0);
  };
}

bool ViewSearch::showsSolid() const {
  const MeshPointer& mesh = document_.mesh();
  return ObjectDrawing::isSolid(*mesh, options_) && (!mesh->has_cells() || levels_->hasSurface(mesh));
}

std::optional<ElementId> ViewSearch::elementAt(QPointF position) const {
  const Frame* frame = document_.solvers().frame(panel_);
  if (frame == nullptr) {
    return std::nullopt;
  }
  const auto nearest = [&](const std::function<bool(ElementId)>& counts) {
    return nearestElement(*frame, boxes(*frame), projection(), position, elementReach, counts);
  };
  if (!showsSolid()) {
    return nearest(shown());
  }
  const QPointF reach(elementReach, elementReach);
  const QRectF part(position - reach, position + reach);
  const FrontFaces front(*frame, projection(), frontFaces(*frame, part), part);
  const auto isShown = shown();
  const auto near = nearest([&](ElementId element) { return (!isShown || isShown(element)) && !front.hides(element); });
  // The cap of a section is none of these faces, so the face that is found there may be hidden.
  return near || options_.section ? near : front.cornerAt(position, isShown);
}

std::vector<LinkId> ViewSearch::linksCrossing(QLineF stroke) const {
  const Frame* frame = document_.solvers().frame(panel_);
  if (frame == nullptr) {
    return {};
  }
  auto crossed = crossedLinks(*frame, boxes(*frame), document_.cuts(), projection(), stroke);
  if (const auto isShown = shown()) {
    std::erase_if(crossed, [&](LinkId link) {
      const auto& [a, b] = frame->mesh->links[link];
      return !isShown(a) && !isShown(b);
    });
  }
  return crossed;
}

std::vector<LinkId> ViewSearch::frontLinksCrossing(QLineF stroke) const {
  std::vector<LinkId> crossed = linksCrossing(stroke);
  const Frame* frame = document_.solvers().frame(panel_);
  if (crossed.empty() || !camera_->spatial()) {
    return crossed;
  }
  const Surface* surface = levels_->surfaceIfAny(frame->mesh, document_.cuts());
  if (frame->mesh->triangles.empty() && (surface == nullptr || surface->table().empty())) {
    return nearestLinks(*frame, boxes(*frame), projection(), stroke, crossed);
  }
  const auto faces = frontFaces(*frame, QRectF(stroke.p1(), stroke.p2()).normalized());
  return unhiddenLinks(*frame, projection(), stroke, crossed, faces);
}

/// Returns the faces that may hide links in a part of the view.
std::vector<Face> ViewSearch::frontFaces(const Frame& frame, QRectF part) const {
  auto faces = wholeFaces(frame, boxes(frame), document_.cuts(), projection(), part);
  if (const Surface* surface = levels_->surfaceIfAny(frame.mesh, document_.cuts())) {
    appendFaces(*surface, faces);
  }
  if (const auto isShown = shown()) {
    std::erase_if(faces, [&](const Face& face) { return std::ranges::none_of(face, isShown); });
  }
  return faces;
}

bool ViewSearch::splits() const { return options_.faces && can_split(*document_.mesh()); }

SplitPointer ViewSearch::splitAlong(std::span<const QPointF> stroke, std::span<const LinkId> reached) const {
  const Frame* frame = document_.solvers().frame(panel_);
  if (frame == nullptr || (!reached.empty() && reached.back() >= frame->mesh->link_count())) {
    return nullptr;
  }
  const Mesh& mesh = *frame->mesh;
  const Projection project = projection();
  std::vector<ViewPlace> places;
  places.reserve(mesh.element_count());
  for (std::size_t first = 0; first < frame->positions.size(); first += std::size_t(mesh.space_dimension)) {
    const auto at = project(frame->positions.data() + first);
    places.push_back({{at.x, at.y}, at.distance});
  }
  std::vector<Eigen::Vector2d> points;
  for (const QPointF& point : stroke) {
    points.emplace_back(point.x(), point.y());
  }
  SplitEdit edit = split_along(mesh, places, points, reached);
  return edit.empty() ? nullptr : make_split(frame->mesh, std::move(edit));
}

std::vector<ElementId> ViewSearch::elementsWhere(QRectF bounds, const std::function<bool(QPointF)>& inside) const {
  const Frame* frame = document_.solvers().frame(panel_);
  return frame == nullptr ? std::vector<ElementId>()
                          : chainmail::elementsWhere(*frame, boxes(*frame), projection(), bounds, inside, shown());
}

}  // namespace chainmail

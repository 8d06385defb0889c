#pragma once

#include "drawing/camera.h"
#include "mesh/generate.h"
#include "plain_picking.h"

namespace chainmail {

/// An object in a view, without a window.
struct Scene {
  explicit Scene(const MeshRecipe& recipe) : Scene(generate(recipe)) {}
  explicit Scene(const MeshPointer& mesh) : level(wholeLevel(mesh)) {
    frame.mesh = mesh;
    frame.positions.assign(mesh->rest.begin(), mesh->rest.end());
    frame.number = 1;
    frame.changed.assign((mesh->element_count() + Frame::block_elements - 1) / Frame::block_elements, 1);
    camera.fit(bounds(*mesh), std::span(mesh->axes).first(std::size_t(mesh->space_dimension)), view);
    boxes.follow(level, frame);
  }
  Projection projection() const { return {*frame.mesh, camera.toView(), camera.toClip(view), view}; }
  QPointF place(ElementId e) const {
    const auto at = plain::viewPosition(frame, projection(), e);
    return {at.x, at.y};
  }

  std::optional<ElementId> nearest(QPointF at, double reach) const {
    return nearestElement(frame, boxes, projection(), at, reach);
  }
  std::vector<LinkId> crossed(const Cuts& cuts, QLineF stroke) const {
    return crossedLinks(frame, boxes, cuts, projection(), stroke);
  }
  std::vector<ElementId> elementsIn(const QRectF& rectangle) const {
    return elementsWhere(frame, boxes, projection(), rectangle, [&](QPointF at) { return rectangle.contains(at); });
  }

  QSizeF view{800, 600};
  Frame frame;
  Camera camera;
  MeshLevelPointer level;
  ClusterBoxes boxes;
};

}  // namespace chainmail

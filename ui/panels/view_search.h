#pragma once

#include <QLineF>
#include <QPointF>
#include <QRectF>
#include <QWidget>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "document/document.h"
#include "drawing/camera.h"
#include "drawing/mesh_levels.h"
#include "drawing/object_drawing.h"
#include "drawing/picking.h"
#include "drawing/projection.h"

namespace chainmail {

/// Finds elements, links and faces of a panel's newest frame by their position in its view. Positions in the view are
/// in logical pixels from its top left corner.
class ViewSearch {
 public:
  /// Refers to what the view has now and later.
  ViewSearch(const QWidget& view, const Document& document, int panel, const std::shared_ptr<Camera>& camera,
             const std::shared_ptr<MeshLevels>& levels, const DrawOptions& options)
      : view_(view), document_(document), panel_(panel), camera_(camera), levels_(levels), options_(options) {}

  /// Returns the element at a position, if there is one: the nearest that can be seen, otherwise the nearest corner of
  /// the face that is seen there.
  std::optional<ElementId> elementAt(QPointF position) const;
  /// Returns the elements for whose position in the view `inside` returns true. `bounds` must contain all these
  /// positions.
  std::vector<ElementId> elementsWhere(QRectF bounds, const std::function<bool(QPointF)>& inside) const;
  std::vector<LinkId> linksCrossing(QLineF stroke) const;
  /// Returns the crossed links of the front layer; in a plane, all crossed links.
  std::vector<LinkId> frontLinksCrossing(QLineF stroke) const;
  /// True if a stroke may split the faces or cells that it crosses: faces are drawn, and they can be split.
  bool splits() const;
  /// Returns the split of the faces or cells along a stroke, where it crosses the reached links, which are ascending;
  /// null if nothing comes apart.
  SplitPointer splitAlong(std::span<const QPointF> stroke, std::span<const LinkId> reached) const;

  Projection projection() const;
  /// The boxes of a frame in which elements are searched.
  const ClusterBoxes& boxes(const Frame& frame) const;
  /// Computes these boxes for some time. Returns true if they are complete.
  bool prepare(const Frame& frame, std::chrono::milliseconds time) const;
  /// True if the object is drawn as a solid, whose faces hide what is behind them.
  bool showsSolid() const;

 private:
  /// Returns a filter for the elements that the section does not hide; empty without a section.
  std::function<bool(ElementId)> shown() const;
  std::vector<MeshLevel::Face> frontFaces(const Frame& frame, QRectF part) const;

  const QWidget& view_;
  const Document& document_;
  const int panel_;
  const std::shared_ptr<Camera>& camera_;
  const std::shared_ptr<MeshLevels>& levels_;
  const DrawOptions& options_;
  mutable ClusterBoxes boxes_;  // of the newest frame that was searched
};

}  // namespace chainmail

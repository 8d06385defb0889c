#pragma once

#include <QObject>
#include <QPointF>
#include <array>
#include <optional>
#include <vector>

#include "document/document.h"
#include "panels/overlay.h"

namespace chainmail {

/// Middle and size of the elements that rotate, in a panel (mesh units).
struct RotationExtent {
  Point pivot = Point::Zero();
  double reach = 0;
  std::uint64_t frame = 0, series = 0;  // that it was computed in
};

/// The ring with which the Drag tool rotates the selection. Each view shows it around the selection's pivot, if the
/// Drag tool is active and at least two selected elements are not pinned. While a handle rotates, the view under the
/// cursor also shows the angle.
class RotationRing : public QObject, public Overlay {
  Q_OBJECT

 public:
  explicit RotationRing(const Document& document);

  /// True if an object can rotate. An object on a line cannot.
  static bool canRotate(const Mesh& mesh) { return mesh.space_dimension > 1; }

  /// The elements that the ring rotates, ascending: the selected ones that are not pinned. Empty without a ring.
  const std::vector<ElementId>& elements() const { return elements_; }
  void setActive(bool active);
  /// True if the ring is at a position in the view (logical pixels).
  bool isAt(const View& view, QPointF position) const;
  /// Highlights the ring under the cursor.
  void setHovered(bool hovered);

  /// Shows how far a handle has rotated, and the ring around it.
  void showRotation(const std::vector<ElementId>& handle, int panel, QPointF cursor, double degrees);
  void hideRotation();

  void draw(const Canvas& canvas) override;
  std::vector<Annotation> annotations(const View& view) const override;

 signals:
  void changed();

 private:
  /// A rotation in progress.
  struct Turn {
    std::vector<ElementId> handle;
    int panel = 0;  // the panel under the cursor
    QPointF cursor;
    double degrees = 0;
  };
  struct Circle {
    Point pivot = Point::Zero();
    double radius = 0, unitsPerPixel = 1;  // logical pixels, and mesh units per pixel
  };

  void followSelection();
  const std::vector<ElementId>& rotated() const { return turn_ ? turn_->handle : elements_; }
  const RotationExtent& extent(const View& view) const;
  std::optional<Circle> circle(const View& view) const;

  const Document& document_;
  bool active_ = false;
  bool hovered_ = false;
  std::vector<ElementId> elements_;
  std::optional<Turn> turn_;
  mutable std::array<std::optional<RotationExtent>, Document::maxPanels> extents_;  // of each panel's present frame
};

}  // namespace chainmail

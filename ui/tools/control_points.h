#pragma once

#include <optional>
#include <vector>

#include "document/document.h"
#include "panels/overlay.h"

namespace chainmail {

/// Draws the control points of free-form deformation and their lattice, in the panels that run it, and finds the point
/// under the cursor for the drag tool.
class ControlPoints : public QObject, public Overlay {
  Q_OBJECT

 public:
  explicit ControlPoints(const Document& document) : document_(document) {}

  /// Identifies a control point of a panel.
  struct PointId {
    int panel = 0;
    std::uint32_t point = 0;
    bool operator==(const PointId&) const = default;
  };
  /// Returns the nearest control point within 10 logical pixels of a position in a view.
  std::optional<PointId> at(const View& view, QPointF place) const;
  /// Returns the position of a control point (mesh units).
  Point position(const PointId& id) const;
  /// Marks the point under the cursor. `held` is true if the user has grabbed it.
  void mark(const std::optional<PointId>& id, bool held = false);

  void draw(const Canvas& canvas) override;

 signals:
  void changed();

 private:
  /// Returns the frame of a panel; null unless it has control points.
  const Frame* frame(int panel) const;
  void drawLattice(const Canvas& canvas, const std::vector<QVector3D>& positions) const;

  const Document& document_;
  std::optional<PointId> marked_;
  bool held_ = false;
};

}  // namespace chainmail

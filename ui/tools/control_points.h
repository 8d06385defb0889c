#pragma once

#include <optional>
#include <vector>

#include "document/document.h"
#include "panels/overlay.h"

namespace chainmail {

/// The control points of free-form deformation with the lattice between them, in the panels that run it; the drag tool
/// finds them here.
class ControlPoints : public QObject, public Overlay {
  Q_OBJECT

 public:
  explicit ControlPoints(const Document& document) : document_(document) {}

  /// One of a panel's.
  struct Handle {
    int panel = 0;
    std::uint32_t point = 0;
    bool operator==(const Handle&) const = default;
  };
  /// The nearest to a place of a view within the reach of a cursor.
  std::optional<Handle> at(const View& view, QPointF place) const;
  /// Where it stands (mesh units).
  Point position(const Handle& handle) const;
  /// The one that the cursor is at, or that the hand holds.
  void mark(const std::optional<Handle>& handle, bool held = false);

  void draw(const Canvas& canvas) override;

 signals:
  void changed();

 private:
  /// The frame of a panel that has control points.
  const Frame* frame(int panel) const;
  void drawLattice(const Canvas& canvas, const std::vector<QVector3D>& places) const;

  const Document& document_;
  std::optional<Handle> marked_;
  bool held_ = false;
};

}  // namespace chainmail

#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "drawing/annotation.h"
#include "drawing/object_drawing.h"

namespace chainmail {

class View;

/// What the colours of an overlay mean.
struct OverlayLegend {
  QString title;
  ColourScale scale;
  QString toolTip;
};

/// Something that is drawn over the objects of the views, and may say how the objects themselves are painted meanwhile.
/// Whoever adds one to a view lets it live as long as the view.
class Overlay {
 public:
  /// One view as it is drawn.
  struct Canvas {
    ObjectDrawing& painter;
    const ObjectDrawing::Scene& scene;
    const Frame& frame;  // what the painter shows
    int panel;
    double unitsPerPixel;  // mesh units that a logical pixel spans, in the plane through the view's centre
  };

  Overlay() = default;
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
  virtual ~Overlay() = default;

  /// How a panel's object is painted under it; none: as without it.
  virtual std::optional<ObjectDrawing::Paint> paint(int /*panel*/) const { return std::nullopt; }
  virtual void draw(const Canvas& canvas) = 0;
  /// Lines with words, over all that is drawn.
  virtual std::vector<Annotation> annotations(const View& /*view*/) const { return {}; }
  /// What a panel says of it beside its algorithm; empty: nothing.
  virtual QString note(int /*panel*/) const { return {}; }
  /// What a panel's legend says instead of the object's own, where the overlay colours it.
  virtual std::optional<OverlayLegend> legend(int /*panel*/) const { return std::nullopt; }
};

}  // namespace chainmail

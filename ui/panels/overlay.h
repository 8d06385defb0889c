#pragma once

#include <QColor>
#include <QFontMetricsF>
#include <QLineF>
#include <QSizeF>
#include <QString>
#include <optional>
#include <vector>

#include "drawing/object_drawing.h"

class QPainter;

namespace chainmail {

class View;

/// A line over the object of a view, with a text at its middle (logical pixels).
struct Annotation {
  QLineF line;
  QString words;
};

/// Draws the ends of the line and the text, but not the line itself.
void drawAnnotation(QPainter& painter, const Annotation& annotation, QColor ground, QSizeF view);
inline constexpr double annotationPadding = 4;      // pixels between the text and the edge of its box
inline constexpr double annotationEndDiameter = 9;  // pixels, diameter of the rings at the ends of the line

/// The legend for the colours of an overlay.
struct OverlayLegend {
  QString title;
  ColourScale scale;
  QString toolTip;
};

/// Draws over the objects of the views, and may colour the objects. An overlay must outlive the views that it was added
/// to.
class Overlay {
 public:
  /// The view that is being painted.
  struct Canvas {
    const View& view;
    ObjectDrawing& painter;
    const ObjectDrawing::Scene& scene;
    const Frame& frame;  // the frame that the painter draws
    int panel;
    double unitsPerPixel;  // mesh units per logical pixel, in the plane through the centre of the view
  };

  Overlay() = default;
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
  virtual ~Overlay() = default;

  /// Returns the colours of a panel's object; no value if the overlay does not change them.
  virtual std::optional<ObjectDrawing::Paint> paint(int /*panel*/) const { return std::nullopt; }
  virtual void draw(const Canvas& canvas) = 0;
  /// Returns lines with texts, drawn over everything else.
  virtual std::vector<Annotation> annotations(const View& /*view*/) const { return {}; }
  /// Returns a note for the head of a panel; may be empty.
  virtual QString note(int /*panel*/) const { return {}; }
  /// True if the overlay shows a panel's object in the middle of its last pass. The figures are those after the pass.
  virtual bool isInMidPass(int /*panel*/) const { return false; }
  /// Returns the legend of a panel whose object the overlay colours.
  virtual std::optional<OverlayLegend> legend(int /*panel*/) const { return std::nullopt; }
};

}  // namespace chainmail

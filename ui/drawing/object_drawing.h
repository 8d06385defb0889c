#pragma once

#include <QColor>
#include <QMatrix4x4>
#include <QPointF>
#include <QSizeF>
#include <QVector2D>
#include <QVector3D>
#include <functional>
#include <span>
#include <vector>

#include "drawing/colour_values.h"
#include "drawing/look.h"
#include "mesh/cuts.h"
#include "simulate/frame.h"

class QPainter;

namespace chainmail {

/// Draws frames of an object as a scene shows them, and marks over it: on the screen, or in lines for print.
class ObjectDrawing {
 public:
  struct Scene {
    QMatrix4x4 toView, toClip;
    QSizeF size;    // of the view, in device pixels
    QVector2D fog;  // distances at which fading with depth begins and ends; equal: none
    QColor background;
    float pixelRatio = 1;

    QSizeF logicalSize() const { return size / double(pixelRatio); }
  };
  /// What the object is drawn with: one colour or, where there are values of its mesh, the colour map.
  struct Paint {
    QColor colour;
    const ColourValues* values = nullptr;
    ColourScale scale;
    Look look = {};
  };
  /// Marks are told apart by shape, not by colour alone.
  enum class Mark { disc = 2, diamond = 3, ring = 4 };
  enum class Shape { segments, triangles, discs, rings };

  ObjectDrawing() = default;
  ObjectDrawing(const ObjectDrawing&) = delete;
  ObjectDrawing& operator=(const ObjectDrawing&) = delete;
  virtual ~ObjectDrawing() = default;

  /// Takes the frame over; both must stay as they are until the next one, but for cuts that it is told of.
  virtual void setFrame(const Frame& frame, const Cuts& cuts) = 0;

  /// The object itself. `pixelsPerUnit` (logical pixels) decides how finely it is drawn.
  virtual void drawObject(const Scene& scene, const Paint& paint, double pixelsPerUnit) = 0;
  /// What `draw` draws, as a whole over what is there: at opacity 0 it is not asked at all.
  virtual void drawSeeThrough(const Scene& scene, double opacity, const std::function<void()>& draw) = 0;
  /// Sizes of marks are in logical pixels.
  virtual void drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                            Mark mark = Mark::disc) = 0;
  /// Elements to be marked by drawSelection, with rings of up to this diameter.
  virtual void setSelection(const std::vector<ElementId>& elements) = 0;
  virtual void drawSelection(const Scene& scene, QColor colour, float diameter) = 0;
  virtual void drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) = 0;
  /// A line through places of the view (logical pixels).
  virtual void drawStroke(const Scene& scene, std::span<const QPointF> places, QColor colour) = 0;
  /// Pairs of ends or triples of corners, in mesh units on all three axes, over everything else; lines in logical
  /// pixels.
  virtual void drawInSpace(const Scene& scene, std::span<const QVector3D> places, Shape shape, QColor colour,
                           float width = 1) = 0;
  /// The same, coloured by a value for each place; in space what lies behind faces is hidden. Discs and rings are as
  /// wide as lines would be.
  virtual void drawValued(const Scene& scene, std::span<const QVector3D> places, std::span<const float> values,
                          const ColourScale& scale, Shape shape, float width) = 0;
  /// Over all that was drawn before, in logical pixels.
  virtual void drawWords(const Scene& scene, const std::function<void(QPainter&)>& draw) = 0;

  // What is alike however it is drawn (logical pixels).
  static constexpr float valuedWidth = 2;  // a thinner line is blended all over, and no colour of the map any more
  static constexpr float litWidth = 3;
  static constexpr float elementSize = 4.5F;
  static constexpr float smallestRing = 6;  // below, a ring has no hole to be seen

  /// Whether every element is marked: where there are few and they stand apart.
  static bool marksElements(const Mesh& mesh, double pixelsPerUnit);
  /// What faces are filled with, where they are not lit. In a plane they are only hinted at; in space they hide what
  /// lies behind them. Beside the colour map they stay grey.
  static QColor faceColour(const Mesh& mesh, const Paint& paint);
  /// What a section's face is filled with, where it is not lit: one sees that it is none of the object's own.
  static QColor sectionColour(const Mesh& mesh, const Paint& paint);
  /// Of a face seen from the side, as a share of its colour.
  static float darkestFace(const Look& look);
  /// Whether faces show a picture, or sections the slices of a volume.
  static bool showsPicture(const Mesh& mesh) { return mesh.texture != nullptr && mesh.texture->size[2] == 1; }
  static bool showsSlices(const Mesh& mesh) { return mesh.texture != nullptr && mesh.texture->size[2] > 1; }

 protected:
  static bool valuesFit(const Mesh* mesh, const Paint& paint) {
    return paint.values != nullptr && paint.values->mesh.get() == mesh;
  }
  static QColor ownColour(const Mesh& mesh, const Paint& paint);
  /// Whether faces take the colours of their elements' values, as no link does.
  static bool facesByValues(const Mesh* mesh, const Paint& paint) {
    return valuesFit(mesh, paint) && !paint.values->ofLinks && !paint.look.links && !showsPicture(*mesh);
  }
};

}  // namespace chainmail

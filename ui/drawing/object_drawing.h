#pragma once

#include <QColor>
#include <QMatrix4x4>
#include <QPointF>
#include <QSizeF>
#include <QVector2D>
#include <QVector3D>
#include <QVector4D>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "mesh/cuts.h"
#include "mesh/section.h"
#include "simulate/frame.h"

class QPainter;

namespace chainmail {

/// The parts of an object that are drawn. The faces of a volume are its outer surface. If they are drawn, only the
/// links on that surface are drawn.
struct DrawOptions {
  bool faces = true, links = true;
  /// Hides everything that is in front of this plane at rest. The face of the section closes a volume there.
  std::optional<SectionPlane> section = {};

  bool operator==(const DrawOptions&) const = default;
};

/// The light on faces in space: light from all sides, light from the sky above, and a key light at the upper left of
/// the viewer. The same formula is in resources/shaders/object.frag. Directions are in view space; the brightness is a
/// factor of the colour, near 1 at most.
struct Lighting {
  float everywhere = 1, sky = 0, key = 0;
  /// Light from behind on faces that are seen edge-on, as a fraction of white. If negative, these faces are darker.
  float edge = 0;
  float glint = 0;  // of a shiny surface, as a fraction of white

  /// Returns the light on objects of one colour, on the current ground.
  static Lighting onGround() {
    return colours::ground() == colours::Ground::dark ? Lighting{0.44F, 0.18F, 0.56F, 0.25F, 0.14F}
                                                      : Lighting{0.46F, 0.16F, 0.42F, -0.30F, 0.10F};
  }
  /// Returns weaker light without highlights, so that colours which stand for values read the same as in the legend.
  static Lighting ofValues() { return {0.80F, 0.08F, 0.26F, 0, 0}; }

  QVector4D shares() const { return {everywhere, sky, key, edge}; }

  /// Returns the colour of a lit face; `normal` has length 1 and points to the viewer.
  QColor of(const QColor& colour, const QVector3D& normal) const {
    const float toLight = QVector3D::dotProduct(normal, QVector3D(-0.42F, 0.58F, 0.70F).normalized());
    const QVector3D halfway = (QVector3D(-0.42F, 0.58F, 0.70F).normalized() + QVector3D(0, 0, 1)).normalized();
    const float mirrored = std::max(0.0F, QVector3D::dotProduct(normal, halfway));
    const float grazing = 1 - std::clamp(normal.z(), 0.0F, 1.0F);
    const float brightness = everywhere + sky * (0.5F + 0.5F * normal.y()) + key * std::max(0.0F, toLight);
    const float rim = edge * std::pow(grazing, 3.0F);
    const float shine = glint * std::pow(mirrored, 32.0F);
    const auto channelOf = [&](float channel) {
      const float plain = channel * brightness;
      const float rimmed = rim > 0 ? plain + rim * (1 - plain) : plain * (1 + rim);
      return std::clamp(rimmed + shine, 0.0F, 1.0F);
    };
    return QColor::fromRgbF(channelOf(colour.redF()), channelOf(colour.greenF()), channelOf(colour.blueF()),
                            colour.alphaF());
  }
};

/// Chooses from measured times how much of an object is drawn while it moves. At rest, everything is drawn.
class DetailBudget {
 public:
  /// The pictures of an object: quick while it moves; complete, with smooth edges and occlusion, at rest.
  enum class Detail { quick, complete };

  /// Takes note of a complete picture that took this long (ms).
  void tookComplete(double milliseconds) { complete_ = milliseconds; }
  /// Takes note of a quick picture with this many links and faces. Small pictures say little about large ones. Slow
  /// pictures count more than fast ones, because a lag is felt more than missing detail.
  void tookQuick(std::size_t shapes, double milliseconds) {
    if (shapes > minShapes / 2) {
      const double affordable = double(shapes) * longestFrame / std::max(milliseconds, 0.1);
      const double weight = affordable < maxShapes_ ? 0.7 : 0.3;
      maxShapes_ = std::clamp(maxShapes_ + weight * (affordable - maxShapes_), double(minShapes), double(maxAtRest));
    }
  }

  /// Number of links and faces that may be drawn while the object moves.
  std::size_t maxShapes() const { return std::size_t(maxShapes_); }
  /// True if complete pictures are fast enough to follow the mouse.
  bool affordsComplete() const { return complete_ && *complete_ < shortFrame; }

  static constexpr std::size_t minShapes = 60'000;  // always drawn
  static constexpr std::size_t maxAtRest = 3'000'000;

 private:
  static constexpr double longestFrame = 33, shortFrame = 12;  // ms

  std::optional<double> complete_;  // duration of the last complete picture (ms)
  double maxShapes_ = 300'000;
};

/// Draws the frames of an object, and marks over it. ObjectPainter draws on the screen, VectorPainter for print.
class ObjectDrawing {
 public:
  struct Scene {
    QMatrix4x4 toView, toClip;
    QSizeF size;    // of the view, in device pixels
    QVector2D fog;  // distances at which fading with depth begins and ends; equal: no fading
    QColor background;
    float pixelRatio = 1;
    float linkScale = 1;  // links are that many times as wide as usual
    DetailBudget::Detail detail = DetailBudget::Detail::complete;
    /// Largest number of links and faces to draw.
    std::size_t maxShapes = DetailBudget::maxAtRest;
    /// True if the object hides marks behind it, which are then drawn faintly.
    bool hidesMarks = false;

    QSizeF logicalSize() const { return size / double(pixelRatio); }
  };
  /// How the object is coloured: in one colour, or by the colour map if there are values for its mesh.
  struct Paint {
    QColor colour;
    const ColourValues* values = nullptr;
    ColourScale scale;
    DrawOptions options = {};
  };
  /// Marks differ in shape, not only in colour.
  enum class Mark { disc, diamond, ring };
  enum class Shape { segments, triangles, discs, rings };

  ObjectDrawing() = default;
  ObjectDrawing(const ObjectDrawing&) = delete;
  ObjectDrawing& operator=(const ObjectDrawing&) = delete;
  virtual ~ObjectDrawing() = default;

  /// Sets the frame to draw; called once per paint. Frame and cuts must stay valid until the next call. The cuts may
  /// change if the drawing is notified.
  virtual void setFrame(const Frame& frame, const Cuts& cuts) = 0;

  /// Draws the object. `pixelsPerUnit` (logical pixels per mesh unit) determines the level of detail.
  virtual void drawObject(const Scene& scene, const Paint& paint, double pixelsPerUnit) = 0;
  /// Blends the drawing of `draw` as one layer over the picture. At opacity 0, `draw` is not called.
  virtual void drawSeeThrough(const Scene& scene, double opacity, const std::function<void()>& draw) = 0;
  /// Draws marks at elements; `diameter` is in logical pixels.
  virtual void drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                            Mark mark = Mark::disc) = 0;
  /// Sets the elements that drawSelection marks with rings of at most `diameter` logical pixels.
  virtual void setSelection(const std::vector<ElementId>& elements) = 0;
  virtual void drawSelection(const Scene& scene, QColor colour, float diameter) = 0;
  virtual void drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) = 0;
  /// Draws a line through positions in the view (logical pixels).
  virtual void drawStroke(const Scene& scene, std::span<const QPointF> positions, QColor colour) = 0;
  /// Draws segments (pairs of ends) or triangles over everything else. Positions are in mesh units on all three axes,
  /// `width` is the line width in logical pixels.
  virtual void drawInSpace(const Scene& scene, std::span<const QVector3D> positions, Shape shape, QColor colour,
                           float width = 1) = 0;
  /// Draws segments, discs or rings, coloured by one value per position. In 3D, faces hide everything behind them.
  /// `width` is the width of segments, or the diameter of discs and rings (logical pixels).
  virtual void drawValued(const Scene& scene, std::span<const QVector3D> positions, std::span<const float> values,
                          const ColourScale& scale, Shape shape, float width) = 0;
  /// Calls `draw` to paint text over everything else, in logical pixels.
  virtual void paintOver(const Scene& scene, const std::function<void(QPainter&)>& draw) = 0;

  // Common to all drawings (logical pixels).
  static constexpr float valuedWidth = 2;  // antialiasing changes the colours of thinner lines
  static constexpr float litWidth = 3;
  static constexpr float elementSize = 4.5F;
  static constexpr float smallestRing = 6;  // the hole of a smaller ring is not visible

  /// Returns true if every element gets a mark: there are no links, or few elements that are far enough apart.
  static bool marksElements(const Mesh& mesh, double pixelsPerUnit);
  /// True if the object is drawn as a surface in space, which is lit and hides everything behind it.
  static bool isSolid(const Mesh& mesh, const DrawOptions& options) {
    return options.faces && mesh.space_dimension == 3 && (!mesh.triangles.empty() || mesh.has_cells());
  }
  /// Returns the colour of fully lit faces. Next to links, faces in a plane are almost transparent. Faces are grey if
  /// values colour the links.
  static QColor faceColour(const Mesh& mesh, const Paint& paint);
  /// Returns the colour of the links, which are fainter the shorter they are; on surfaces, thin dark edges.
  static QColor linkColour(const Mesh& mesh, const Paint& paint, double pixelsPerUnit);
  /// Returns the colour of links whose values are neutral. Like all links, they are fainter the shorter they are.
  static QColor neutralColour(const Mesh& mesh, double pixelsPerUnit);
  /// True if links whose values are not neutral are drawn again: thicker, and over all others.
  static bool thickensLinks(const Mesh* mesh, const Paint& paint) {
    return valuesFit(mesh, paint) && paint.values->ofLinks && paint.scale.threshold >= 0;
  }
  /// Returns the width of links that are coloured by values, and of those that are drawn again (logical pixels).
  static float linkWidth(const Mesh& mesh, const Paint& paint, double pixelsPerUnit);
  static float thickWidth(const Mesh& mesh, double pixelsPerUnit);
  /// True if the links on a surface are long enough in the view to be distinguished.
  static bool distinguishesEdges(const Mesh& mesh, double pixelsPerUnit);
  /// Returns the light on the faces of a surface.
  static Lighting lighting(const Mesh& mesh, const Paint& paint);
  /// Returns the largest fading with depth, as a fraction.
  static float fade(const Mesh& mesh, const Paint& paint);
  /// Returns 1 if the triangles of a plane mesh are counterclockwise at rest, -1 if they are clockwise, and 0 if both
  /// occur. Triangles of the other orientation are folded.
  static float frontSign(const Mesh& mesh);
  /// True if faces show a picture.
  static bool showsPicture(const Mesh& mesh) { return mesh.texture != nullptr && mesh.texture->size[2] == 1; }
  /// True if sections show the slices of a volume.
  static bool showsSlices(const Mesh& mesh) { return mesh.texture != nullptr && mesh.texture->size[2] > 1; }

 protected:
  static bool valuesFit(const Mesh* mesh, const Paint& paint) {
    return paint.values != nullptr && paint.values->mesh.get() == mesh;
  }
  static QColor ownColour(const Mesh& mesh, const Paint& paint);
  /// Returns one value per element, which may colour faces: empty if links are coloured only.
  static const std::vector<float>& elementValues(const ColourValues& values) {
    return values.ofLinks ? values.atElements : values.values;
  }
  /// True if the values of the elements colour the faces. In a plane, this requires that links are hidden.
  static bool facesByValues(const Mesh* mesh, const Paint& paint) {
    return valuesFit(mesh, paint) && !elementValues(*paint.values).empty() && !showsPicture(*mesh) &&
           (!paint.options.links || isSolid(*mesh, paint.options));
  }
  /// True if values colour the links.
  static bool linksByValues(const Mesh* mesh, const Paint& paint) {
    return valuesFit(mesh, paint) && !(isSolid(*mesh, paint.options) && facesByValues(mesh, paint));
  }
};

}  // namespace chainmail

#pragma once

#include <QPainter>

#include "drawing/drawn_parts.h"
#include "drawing/object_drawing.h"
#include "drawing/surface_normals.h"

namespace chainmail {

/// Draws vector graphics, for print. It has no depth buffer, so it sorts marks, lines and faces from back to front.
class VectorPainter : public ObjectDrawing {
 public:
  /// `levels` may be shared with other painters of the same mesh.
  VectorPainter(QPainter& painter, std::shared_ptr<MeshLevels> levels);
  ~VectorPainter() override;

  void setFrame(const Frame& frame, const Cuts& cuts) override;
  void drawObject(const Scene& scene, const Paint& paint, double pixelsPerUnit) override;
  void drawSeeThrough(const Scene& scene, double opacity, const std::function<void()>& draw) override;
  void drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                    Mark mark = Mark::disc) override;
  void setSelection(const std::vector<ElementId>& elements) override { selected_ = elements; }
  void drawSelection(const Scene& scene, QColor colour, float diameter) override;
  void drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) override;
  void drawStroke(const Scene& scene, std::span<const QPointF> positions, QColor colour) override;
  void drawInSpace(const Scene& scene, std::span<const QVector3D> positions, Shape shape, QColor colour,
                   float width = 1) override;
  void drawValued(const Scene& scene, std::span<const QVector3D> positions, std::span<const float> values,
                  const ColourScale& scale, Shape shape, float width) override;
  void paintOver(const Scene& scene, const std::function<void(QPainter&)>& draw) override;

 private:
  /// The position of a point in the view, and its distance from the eye (mesh units).
  struct Projected {
    QPointF at;
    float distance = 0;
    bool before = false;  // true if it is in front of the eye
  };
  /// A mark, a line or a face: 1, 2 or 3 corners.
  struct Piece {
    std::array<QPointF, 3> corners;
    int count = 1;
    float distance = 0;
    QColor colour;
    float width = 1;  // width of a line, or diameter of a mark (logical pixels)
    Mark mark = Mark::disc;
  };

  QVector3D inSpace(ElementId element) const;
  static Projected projected(const Scene& scene, const QVector3D& position);
  QColor faded(const Scene& scene, const QColor& colour, float distance) const;
  void add(const Scene& scene, std::span<const QVector3D> positions, const QColor& colour, float width,
           Mark mark = Mark::disc, float lift = 0);
  void addClipped(Piece piece, const QRectF& view);
  void addFaceClipped(Piece piece, const QRectF& view);
  /// Returns how far an element is in front of the section at rest (mesh units); 0 without a section.
  double beforeSection(ElementId element, const DrawOptions& options) const;
  /// Returns the part of a line that the section does not hide, as two fractions of the line, or the corners of that
  /// part of a face.
  std::array<float, 2> shown(ElementId from, ElementId to, const DrawOptions& options) const;
  std::vector<QVector3D> shown(std::span<const ElementId> corners, const DrawOptions& options) const;
  /// Returns the colour of a lit face. Its light is that of the smooth normal at its corners, except at creases.
  QColor lit(const Scene& scene, std::span<const QVector3D> positions, std::span<const ElementId> corners,
             const QColor& colour) const;
  QColor folded(const Scene& scene, const Paint& paint, const std::array<QVector3D, 3>& corners, QColor face) const;
  void addFaces(const Scene& scene, const Paint& paint);
  void addFaces(const Scene& scene, const Paint& paint, std::span<const ElementId> corners, const QColor& colour);
  QColor colourOf(const Scene& scene, const Paint& paint, std::span<const ElementId> corners,
                  const std::array<QVector3D, 3>& part, const QColor& colour) const;
  void addCap(const Scene& scene);
  void addLinks(const Scene& scene, const Paint& paint, double pixelsPerUnit);
  void addLink(const Scene& scene, const std::array<QVector3D, 2>& ends, const std::array<float, 2>& values,
               const ColourScale& scale, float width);
  void addLinkOfValue(const Scene& scene, const std::array<QVector3D, 2>& ends, float value, const Paint& paint,
                      double pixelsPerUnit);
  void addElements(const Scene& scene, const Paint& paint);
  /// Draws all pieces that were added, from back to front.
  void flush();
  void draw(const Piece& piece);

  QPainter& painter_;
  DrawnParts parts_;
  const Frame* frame_ = nullptr;
  QMatrix4x4 meshToWorld_;
  std::vector<ElementId> selected_;
  SurfaceNormals normals_;
  Lighting lighting_;
  float fade_ = 0;  // largest fading with depth
  float frontSign_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace chainmail

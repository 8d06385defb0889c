#pragma once

#include <QOpenGLBuffer>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <array>

#include "drawing/drawn_parts.h"
#include "drawing/see_through.h"

namespace chainmail {

/// Draws with OpenGL. It holds what the graphics card holds and sends only what changed: of positions the blocks that
/// did, of links and faces those that the camera sees, as finely as it can show them. All calls but cutsChanged need
/// the context current.
class ObjectPainter : public ObjectDrawing, protected QOpenGLExtraFunctions {
 public:
  /// `levels` of the mesh may be shared with other painters.
  explicit ObjectPainter(std::shared_ptr<MeshLevels> levels) : parts_(std::move(levels)) {}

  /// Compiles the shaders; throws Error with the driver's words where they do not compile.
  void initialize();
  void destroy();

  /// Links were cut or uncut.
  void cutsChanged() { parts_.cutsChanged(); }

  void setFrame(const Frame& frame, const Cuts& cuts) override;
  void drawObject(const Scene& scene, const Paint& paint, double pixelsPerUnit) override;
  void drawSeeThrough(const Scene& scene, double opacity, const std::function<void()>& draw) override {
    seeThrough_.draw(scene.size.toSize(), opacity, draw);
  }
  void drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                    Mark mark = Mark::disc) override;
  void setSelection(const std::vector<ElementId>& elements) override;
  void drawSelection(const Scene& scene, QColor colour, float diameter) override;
  void drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour) override;
  void drawStroke(const Scene& scene, std::span<const QPointF> places, QColor colour) override;
  void drawInSpace(const Scene& scene, std::span<const QVector3D> places, Shape shape, QColor colour,
                   float width = 1) override;
  void drawValued(const Scene& scene, std::span<const QVector3D> places, std::span<const float> values,
                  const ColourScale& scale, Shape shape, float width) override;
  void drawWords(const Scene& scene, const std::function<void(QPainter&)>& draw) override;

  /// As DrawnParts::step.
  unsigned step() const { return parts_.step(); }
  bool leavesLinksOut() const { return parts_.leavesLinksOut(); }

 private:
  std::array<QOpenGLBuffer*, 10> buffers() {
    return {&positions_, &scratch_, &links_, &faces_, &selected_, &values_, &rest_, &cap_, &capPlaces_, &capRest_};
  }
  void uploadPositions(const Frame& frame);
  void sendParts();
  void use(const Scene& scene, QColor colour, int shading, int dimension, int colouredBy = 0);
  /// Where the object has values: as use(), and what is drawn next takes its colours from them.
  void useValues(const Scene& scene, const Paint& paint, int shading);
  void useMap(const ColourScale& scale);
  void uploadValues(const ColourValues& values);
  bool valuesFit(const Paint& paint) const { return ObjectDrawing::valuesFit(mesh_.get(), paint); }
  void useRest(const Look& look);
  void useTexture();
  void drawFaces(const Scene& scene, const Paint& paint);
  void drawCap(const Scene& scene, const Paint& paint);
  void drawWires(const Scene& scene, const Paint& paint);
  void drawEveryElement(const Scene& scene, const Paint& paint);
  void drawOwn(const Scene& scene, std::span<const float> positions, GLenum mode, QColor colour, int shading,
               float diameter);

  // The shaders, compiled for each pair of their SHADING and COLOURED_BY that is drawn with.
  static constexpr std::array<std::array<int, 2>, 11> variants{
      {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 0}, {2, 0}, {2, 1}, {3, 0}, {4, 0}, {4, 1}}};
  std::array<QOpenGLShaderProgram, variants.size()> programs_;
  QOpenGLShaderProgram* program_ = nullptr;  // the one in use
  QOpenGLVertexArrayObject vertexArray_;
  QOpenGLBuffer positions_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer scratch_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer links_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer faces_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer selected_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer values_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer rest_{QOpenGLBuffer::VertexBuffer};  // of the elements of restMesh_, where something goes by it
  MeshPointer restMesh_;
  QOpenGLBuffer cap_{QOpenGLBuffer::IndexBuffer};  // a section's face, of points of its own
  QOpenGLBuffer capPlaces_{QOpenGLBuffer::VertexBuffer}, capRest_{QOpenGLBuffer::VertexBuffer};
  std::shared_ptr<CardTexture> texture_;
  GLuint valuesTexture_ = 0;  // values_ as the fragment shader reads it
  SeeThrough seeThrough_;
  DrawnParts parts_;
  MeshPointer mesh_;
  const Frame* frame_ = nullptr;
  std::uint64_t frameNumber_ = 0, frameSeries_ = 0;
  std::vector<std::uint32_t> drawnLinks_;  // what links_ was filled with
  GLsizei faceIndices_ = 0, selectedIndices_ = 0, capIndices_ = 0;
  bool capMoved_ = true;  // its points are elsewhere in the newest frame
  Look look_;             // of the object as it is drawn now
  std::uint64_t valuesNumber_ = 0;
};

}  // namespace chainmail

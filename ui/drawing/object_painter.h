#pragma once

#include <QOpenGLBuffer>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <array>

#include "drawing/drawn_parts.h"
#include "drawing/object_layer.h"
#include "drawing/surface_normals.h"

namespace chainmail {

/// Draws with OpenGL. It owns the buffers on the graphics card and sends only changes: the blocks of positions that
/// moved, and the links and faces that the camera sees, as finely as it can show them. A complete picture of a surface
/// is drawn once and kept until it changes. All functions except cutsChanged() require the context to be current.
class ObjectPainter : public ObjectDrawing, protected QOpenGLExtraFunctions {
 public:
  /// `levels` of the mesh may be shared with other painters.
  explicit ObjectPainter(std::shared_ptr<MeshLevels> levels) : parts_(std::move(levels)) {}

  /// Compiles the shaders; throws Error with the driver's log if they do not compile.
  void initialize();
  void destroy();
  /// Call this after a paint that failed in the middle: the next one sends everything to the graphics card again. The
  /// selection must be set again.
  void startOver();
  /// Frees the memory that drawSeeThrough uses until its next call.
  void freeSeeThrough() { seeThrough_.destroy(); }

  /// Call this after links were cut or restored.
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
  void drawStroke(const Scene& scene, std::span<const QPointF> positions, QColor colour) override;
  void drawInSpace(const Scene& scene, std::span<const QVector3D> positions, Shape shape, QColor colour,
                   float width = 1) override;
  void drawValued(const Scene& scene, std::span<const QVector3D> positions, std::span<const float> values,
                  const ColourScale& scale, Shape shape, float width) override;
  void paintOver(const Scene& scene, const std::function<void(QPainter&)>& draw) override;

  /// See DrawnParts.
  unsigned step() const { return parts_.step(); }
  bool leavesLinksOut() const { return parts_.leavesLinksOut(); }
  /// Number of links and faces in the last picture of the object.
  std::size_t shapes() const { return std::size_t(faceIndices_ + freshIndices_) / 3 + drawnLinks_.numbers.size(); }
  /// Returns true if a complete picture was drawn, not only copied, since the last call.
  bool takeLayerDrawn() { return std::exchange(layerDrawn_, false); }

 private:
  /// How shapes are drawn: SHADING of object.frag.
  enum class Shading {
    plain,  // in their colour
    lit,    // faces in space, lit
    disc,   // points as marks
    diamond,
    ring,
    plane  // faces in a plane, darker if folded
  };
  /// Where colours come from: COLOURED_BY of object.frag.
  enum class Colouring { one, elements, links, picture, volume };
  struct Variant {
    Shading shading;
    Colouring colouring;
    bool operator==(const Variant&) const = default;
  };
  static QByteArray definitions(const Variant& variant);
  static Shading shadingOf(Mark mark);

  /// All that the picture of the object depends on.
  struct Drawn {
    QMatrix4x4 toView, toClip;
    QSizeF size;
    QVector2D fog;
    QColor background, colour;
    float pixelRatio = 0;
    std::uint64_t values = 0, frame = 0, series = 0, parts = 0;
    ColourScale scale;
    DrawOptions options;
    bool operator==(const Drawn&) const = default;
  };

  std::array<QOpenGLBuffer*, 14> buffers() {
    return {&positions_, &scratch_, &links_,        &faces_,   &fresh_,   &selected_,      &values_,
            &rest_,      &cap_,     &capPositions_, &capRest_, &normals_, &elementValues_, &thickLinks_};
  }
  void uploadPositions(const Frame& frame);

  void use(const Scene& scene, QColor colour, Shading shading, int dimension, Colouring colouring = Colouring::one);
  void useValues(const Scene& scene, const Paint& paint, Shading shading, bool ofLinks);
  void uploadValues(const Paint& paint);
  void useMap(const ColourScale& scale, QColor neutral);
  void useRest(const DrawOptions& options);
  void useTexture();
  bool valuesFit(const Paint& paint) const { return ObjectDrawing::valuesFit(mesh_.get(), paint); }

  void sendParts();
  void sendNormals();
  void drawParts(const Scene& scene, const Paint& paint, double pixelsPerUnit);
  void drawInLayer(const Scene& scene, const Paint& paint, double pixelsPerUnit);
  Drawn drawnNow(const Scene& scene, const Paint& paint) const;
  void drawFaces(const Scene& scene, const Paint& paint);
  void drawFresh(const Scene& scene, const Paint& paint);
  void useNormals();
  void drawCap(const Scene& scene);
  void drawWires(const Scene& scene, const Paint& paint, double pixelsPerUnit);
  void drawThickLinks(const Scene& scene, const Paint& paint, double pixelsPerUnit);
  void drawLines(const Scene& scene, QOpenGLBuffer& ends, GLsizei count, float width);
  void drawMarked(const Scene& scene, QColor colour, const std::function<void(QColor)>& draw);
  void drawEveryElement(const Scene& scene, const Paint& paint);
  void drawOwn(const Scene& scene, std::span<const float> positions, GLenum mode, QColor colour, Shading shading,
               float diameter);

  // The shaders, compiled for each pair that is used.
  static constexpr std::array<Variant, 15> variants{{{Shading::plain, Colouring::one},
                                                     {Shading::plain, Colouring::elements},
                                                     {Shading::plain, Colouring::links},
                                                     {Shading::plain, Colouring::picture},
                                                     {Shading::plain, Colouring::volume},
                                                     {Shading::lit, Colouring::one},
                                                     {Shading::lit, Colouring::elements},
                                                     {Shading::disc, Colouring::one},
                                                     {Shading::disc, Colouring::elements},
                                                     {Shading::diamond, Colouring::one},
                                                     {Shading::ring, Colouring::one},
                                                     {Shading::ring, Colouring::elements},
                                                     {Shading::plane, Colouring::one},
                                                     {Shading::plane, Colouring::elements},
                                                     {Shading::plane, Colouring::picture}}};
  std::array<QOpenGLShaderProgram, variants.size()> programs_;
  QOpenGLShaderProgram* program_ = nullptr;  // the one in use
  QOpenGLVertexArrayObject vertexArray_;
  QOpenGLBuffer positions_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer scratch_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer links_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer faces_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer fresh_{QOpenGLBuffer::IndexBuffer};     // the faces that cuts have made visible
  QOpenGLBuffer normals_{QOpenGLBuffer::VertexBuffer};  // one per element
  QOpenGLBuffer selected_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer values_{QOpenGLBuffer::VertexBuffer};  // of the drawn links, then of the thick ones among them
  QOpenGLBuffer elementValues_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer thickLinks_{QOpenGLBuffer::IndexBuffer};  // see thickensLinks
  QOpenGLBuffer rest_{QOpenGLBuffer::VertexBuffer};       // rest positions of restMesh_, for sections and pictures
  MeshPointer restMesh_;
  QOpenGLBuffer cap_{QOpenGLBuffer::IndexBuffer};  // the face of a section, which has points of its own
  QOpenGLBuffer capPositions_{QOpenGLBuffer::VertexBuffer}, capRest_{QOpenGLBuffer::VertexBuffer};
  std::shared_ptr<CardTexture> texture_;
  GLuint valuesTexture_ = 0;  // values_ as a texture, for the fragment shader
  SeeThrough seeThrough_;
  ObjectLayer layer_;
  Drawn inLayer_;  // what the layer shows
  bool layerDrawn_ = false;
  SurfaceNormals normalsOf_;
  bool normalsOutdated_ = true;  // true if the graphics card has normals of other faces
  DrawnParts parts_;
  MeshPointer mesh_;
  const Frame* frame_ = nullptr;
  std::uint64_t frameNumber_ = 0, frameSeries_ = 0;
  DrawnLinks drawnLinks_;  // the links in links_
  GLsizei thickIndices_ = 0;
  GLsizei faceIndices_ = 0, freshIndices_ = 0, selectedIndices_ = 0, capIndices_ = 0;
  std::uint64_t partsNumber_ = 0;  // grows when the drawn parts or the section change
  float frontSign_ = 0;            // see ObjectDrawing::frontSign
  bool capMoved_ = true;           // true if capPositions_ is older than the newest frame
  Lighting lighting_;              // of the object that is being drawn
  float fade_ = 0;
  std::uint64_t valuesNumber_ = 0;
};

}  // namespace chainmail

#pragma once

#include <QColor>
#include <QMatrix4x4>
#include <QOpenGLBuffer>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <QSizeF>
#include <QVector2D>
#include <array>
#include <span>

#include "cell_boxes.h"
#include "colour_values.h"
#include "drawn_indices.h"
#include "mesh_levels.h"

namespace chainmail {

/// Draws frames of an object with OpenGL: links, faces, elements. It holds what the graphics card holds
/// and sends only what changed: of positions the blocks that did, of links and faces those that the camera sees, as
/// finely as it can show them. All calls but cutsChanged need the context current.
class ObjectPainter : protected QOpenGLExtraFunctions {
 public:
  /// `levels` of the mesh may be shared with other painters.
  explicit ObjectPainter(std::shared_ptr<MeshLevels> levels) : levels_(std::move(levels)) {}

  struct Scene {
    QMatrix4x4 toView, toClip;
    QSizeF size;    // of the view, in device pixels
    QVector2D fog;  // distances at which fading with depth begins and ends; equal: none
    QColor background;
    float pixelRatio = 1;
  };
  /// What colours the object: one colour or, where there are values of its mesh, the colour map.
  struct Paint {
    QColor colour;
    const ColourValues* values = nullptr;
    ColourScale scale;
  };
  /// Marks are told apart by shape, not by colour alone.
  enum class Mark { disc = 2, diamond = 3, ring = 4 };

  /// Compiles the shaders; throws Error with the driver's words where they do not compile.
  void initialize();
  void destroy();

  /// Takes the frame over; both must stay as they are until the next one, the cuts but for cutsChanged.
  void setFrame(const Frame& frame, const Cuts& cuts);
  /// Links were cut or uncut.
  void cutsChanged() { listsOutdated_ = true; }

  /// The object itself. `pixelsPerUnit`, logical ones, decides how finely it is drawn.
  void drawObject(const Scene& scene, const Paint& paint, double pixelsPerUnit);
  void drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                    Mark mark = Mark::disc);
  /// Elements to be marked by drawSelection, with rings of up to this diameter (logical pixels).
  void setSelection(const std::vector<ElementId>& elements);
  void drawSelection(const Scene& scene, QColor colour, float diameter);
  void drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour);
  /// A line through places of the view (logical pixels).
  void drawStroke(const Scene& scene, std::span<const QPointF> places, QColor colour);
  enum class Shape { segments, triangles, discs, rings };
  /// Pairs of ends or triples of corners, in mesh units on all three axes, over everything else; lines in logical
  /// pixels.
  void drawInSpace(const Scene& scene, std::span<const QVector3D> places, Shape shape, QColor colour, float width = 1);
  /// The same, coloured by a value for each place; in space what lies behind faces is hidden. Discs and rings are as
  /// wide as lines would be.
  void drawValued(const Scene& scene, std::span<const QVector3D> places, std::span<const float> values,
                  const ColourScale& scale, Shape shape, float width);

  /// 1 where every link is drawn; k where about k links in a row are drawn as one.
  unsigned step() const { return step_; }

 private:
  void uploadPositions(const Frame& frame);
  void chooseStep(const Scene& scene, double pixelsPerUnit);
  double shareInView(const Scene& scene);
  /// The cells of a level that may be seen.
  std::vector<std::uint32_t> visibleCells(const Scene& scene, const MeshLevelPointer& level, CellBoxes& boxes) const;
  void makeLists(const Scene& scene);
  void use(const Scene& scene, QColor colour, int shading, int dimension, int colouredBy = 0);
  /// Where the object has values: as use(), and what is drawn next takes its colours from them.
  void useValues(const Scene& scene, const Paint& paint, int shading);
  void useMap(const ColourScale& scale);
  void uploadValues(const ColourValues& values);
  bool valuesFit(const Paint& paint) const { return paint.values != nullptr && paint.values->mesh == mesh_; }
  void drawFaces(const Scene& scene, const Paint& paint);
  void drawWires(const Scene& scene, const Paint& paint);
  void drawEveryElement(const Scene& scene, const Paint& paint);
  void drawOwn(const Scene& scene, std::span<const float> positions, GLenum mode, QColor colour, int shading,
               float diameter);

  // The shaders, compiled for each pair of their SHADING and COLOURED_BY that is drawn with.
  static constexpr std::array<std::array<int, 2>, 9> variants{
      {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {2, 0}, {2, 1}, {3, 0}, {4, 0}, {4, 1}}};
  std::array<QOpenGLShaderProgram, variants.size()> programs_;
  QOpenGLShaderProgram* program_ = nullptr;  // the one in use
  QOpenGLVertexArrayObject vertexArray_;
  QOpenGLBuffer positions_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer scratch_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer links_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer faces_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer selected_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer values_{QOpenGLBuffer::VertexBuffer};
  GLuint valuesTexture_ = 0;  // values_ as the fragment shader reads it
  std::shared_ptr<MeshLevels> levels_;
  MeshPointer mesh_;
  const Cuts* cuts_ = nullptr;
  const Frame* frame_ = nullptr;
  std::uint64_t frameNumber_ = 0, frameSeries_ = 0;
  unsigned step_ = 1;
  MeshLevelPointer level_;
  CellBoxes boxes_;       // of that level
  CellBoxes wholeBoxes_;  // of every element
  // What links_ and faces_ were filled with.
  std::vector<std::uint32_t> cells_;
  std::vector<std::uint32_t> drawnLinks_;  // their numbers in the level
  bool listsOutdated_ = true;
  GLsizei faceIndices_ = 0, selectedIndices_ = 0;
  std::uint64_t valuesNumber_ = 0;
};

}  // namespace chainmail

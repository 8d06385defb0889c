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

#include "colour_values.h"
#include "mesh/cuts.h"
#include "simulate/frame.h"

namespace chainmail {

/// Draws frames of an object with OpenGL: links, faces, elements. It holds what the graphics card holds
/// and sends only what changed. All calls need the context current.
class ObjectPainter : protected QOpenGLExtraFunctions {
 public:
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

  /// Takes the frame over: positions always, the mesh's links and faces where they are others.
  void setFrame(const Frame& frame, const Cuts& cuts);
  /// Links were cut or uncut.
  void setCuts(const Cuts& cuts);

  /// The object itself. `pixelsPerUnit` decides how finely it is drawn.
  void drawObject(const Scene& scene, const Paint& paint, double pixelsPerUnit);
  void drawElements(const Scene& scene, std::span<const ElementId> elements, QColor colour, float diameter,
                    Mark mark = Mark::disc);
  /// Elements to be marked by drawSelection, with rings of up to this diameter (logical pixels).
  void setSelection(const std::vector<ElementId>& elements);
  void drawSelection(const Scene& scene, QColor colour, float diameter);
  void drawLinks(const Scene& scene, std::span<const LinkId> links, QColor colour);
  /// A line through places of the view (logical pixels).
  void drawStroke(const Scene& scene, std::span<const QPointF> places, QColor colour);

  /// 1 where every link is drawn; k where every k-th row of the lattice or every k-th element is.
  unsigned step() const { return step_; }

 private:
  void setMesh(const MeshPointer& mesh, const Cuts& cuts);
  void chooseStep(double pixelsPerUnit);
  void makeCoarse();
  void use(const Scene& scene, QColor colour, int shading, int dimension);
  /// After use(): what is drawn next takes its colours from the values.
  void useValues(const Paint& paint, bool ofLinks);
  void uploadValues(const ColourValues& values, bool ofLinks);
  bool valuesFit(const Paint& paint) const { return paint.values != nullptr && paint.values->mesh == mesh_; }
  bool linksKeepValues(const Paint& paint) const;
  void drawFaces(const Scene& scene, const Paint& paint);
  void drawWires(const Scene& scene, const Paint& paint);
  void drawEveryElement(const Scene& scene, const Paint& paint);
  void drawOwn(const Scene& scene, std::span<const float> positions, GLenum mode, QColor colour, int shading,
               float diameter);

  QOpenGLShaderProgram program_;
  QOpenGLVertexArrayObject vertexArray_;
  QOpenGLBuffer positions_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer scratch_{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer links_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer coarse_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer faces_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer selected_{QOpenGLBuffer::IndexBuffer};
  QOpenGLBuffer values_{QOpenGLBuffer::VertexBuffer};
  GLuint valuesTexture_ = 0;  // values_ as the fragment shader reads it
  GLint largestTexture_ = 0;  // values
  MeshPointer mesh_;
  Cuts cuts_;
  const Frame* frame_ = nullptr;
  std::uint64_t frameNumber_ = 0;
  GLsizei linkIndices_ = 0, coarseIndices_ = 0, faceIndices_ = 0, selectedIndices_ = 0;
  // Indices are made when they are first drawn.
  bool linksOutdated_ = true, facesOutdated_ = true;
  unsigned step_ = 1;
  unsigned coarseStep_ = 0;  // the step that coarse_ was filled for; 0 none
  std::uint64_t valuesNumber_ = 0;
  bool valuesOfLinks_ = false;  // what values_ was filled with
};

}  // namespace chainmail

#pragma once

#include <QOpenGLBuffer>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <QSize>

namespace chainmail {

/// A picture of an object with smooth edges (multisampling) and its depths, which is kept and copied until the object
/// changes. It can be darkened where other parts of the object hide the light (ambient occlusion). All calls require
/// the context to be current.
class ObjectLayer : protected QOpenGLExtraFunctions {
 public:
  ObjectLayer() = default;
  ObjectLayer(const ObjectLayer&) = delete;
  ObjectLayer& operator=(const ObjectLayer&) = delete;

  /// The projection of the picture. Lengths are in mesh units.
  struct Occlusion {
    QMatrix4x4 toClip;
    float reach = 0;      // radius of the neighbourhood that may hide light; 0: no occlusion
    float darkening = 0;  // of surfaces that get no light, as a fraction
  };

  /// Compiles the shaders; throws Error if they do not compile.
  void initialize();
  void destroy();

  /// Binds an empty picture of this size (device pixels) for drawing.
  void begin(QSize size);
  /// Ends the drawing, and binds the framebuffer from before begin() again.
  void end(const Occlusion& occlusion);
  /// Copies the picture and its depths into the bound framebuffer. Leaves pixels alone where nothing was drawn.
  void copy();

 private:
  /// A framebuffer with its attachments.
  struct Canvas {
    GLuint framebuffer = 0;
    std::array<GLuint, 2> attachments{};  // renderbuffers or textures: colour, depth
  };
  void allocate(QSize size);
  void makeSampled(QSize size);
  void makeTextured(Canvas& canvas, QSize size, GLenum colour, bool withDepth);
  void release();
  void darken(const Occlusion& occlusion);
  void drawTriangle();

  Canvas sampled_, resolved_, occluded_;  // multisampled; with textures; occlusion at half the resolution
  QOpenGLShaderProgram occlusion_, copy_;
  QOpenGLVertexArrayObject vertexArray_;
  QSize size_;
  GLint below_ = 0;  // the framebuffer from before begin()
  float darkening_ = 0;
};

}  // namespace chainmail

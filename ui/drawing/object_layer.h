#pragma once

#include <QOpenGLBuffer>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLTextureBlitter>
#include <QOpenGLVertexArrayObject>
#include <QSize>
#include <functional>
#include <memory>

class QOpenGLFramebufferObject;

namespace chainmail {

/// Compiles a program from two files of resources/shaders. `head` follows the version line, for example definitions.
/// Throws Error with the driver's log if they do not compile.
void buildProgram(QOpenGLShaderProgram& program, const char* vertex, const char* fragment, const QByteArray& head = {});

/// Draws an object see-through: draws it into an empty picture, and blends this picture as one layer over the current
/// one. So the object hides its own back, but not the objects behind it. All calls require the context to be current.
class SeeThrough {
 public:
  SeeThrough();
  ~SeeThrough();

  /// `size` is the size of the bound framebuffer (device pixels). At opacity 1, `drawObject` draws there directly; at
  /// opacity 0 it is not called.
  void draw(QSize size, double opacity, const std::function<void()>& drawObject);
  void destroy();

 private:
  void layOver(double opacity);

  std::unique_ptr<QOpenGLFramebufferObject> picture_;
  std::unique_ptr<QOpenGLTextureBlitter>
      blitter_;  // a new object each time, because Qt cannot create it again after destroy()
};

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

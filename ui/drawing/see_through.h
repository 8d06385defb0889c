#pragma once

#include <QOpenGLTextureBlitter>
#include <QSize>
#include <functional>
#include <memory>

class QOpenGLFramebufferObject;

namespace chainmail {

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

}  // namespace chainmail

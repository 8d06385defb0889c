#pragma once

#include <QOpenGLTextureBlitter>
#include <QSize>
#include <functional>
#include <memory>

class QOpenGLFramebufferObject;

namespace chainmail {

/// Draws on an empty picture and lays that over what is there, as a whole: a solid object stays solid in itself and
/// lets through what lies behind it. All calls need the context current.
class SeeThrough {
 public:
  SeeThrough();
  ~SeeThrough();

  /// `size` is that of what is drawn on now (device pixels). Opaque, `drawObject` draws there at once; at opacity 0 it
  /// is not asked at all.
  void draw(QSize size, double opacity, const std::function<void()>& drawObject);
  void destroy();

 private:
  void layOver(double opacity);

  std::unique_ptr<QOpenGLFramebufferObject> picture_;
  std::unique_ptr<QOpenGLTextureBlitter> blitter_;  // Qt's cannot be created again once it was destroyed
};

}  // namespace chainmail

#include "drawing/see_through.h"

#include <QMatrix4x4>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>

namespace chainmail {

SeeThrough::SeeThrough() = default;
SeeThrough::~SeeThrough() = default;

void SeeThrough::draw(QSize size, double opacity, const std::function<void()>& drawObject) {
  if (opacity <= 0) {
    return;
  }
  auto* gl = QOpenGLContext::currentContext()->functions();
  if (opacity >= 1) {
    gl->glClear(GL_DEPTH_BUFFER_BIT);
    drawObject();
    return;
  }
  GLint below = 0;
  gl->glGetIntegerv(GL_FRAMEBUFFER_BINDING, &below);
  if (picture_ == nullptr || picture_->size() != size) {
    picture_ = std::make_unique<QOpenGLFramebufferObject>(size, QOpenGLFramebufferObject::CombinedDepthStencil);
  }
  picture_->bind();
  gl->glClearColor(0, 0, 0, 0);
  gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  drawObject();
  gl->glBindFramebuffer(GL_FRAMEBUFFER, GLuint(below));
  layOver(opacity);
}

/// The colours of the picture are already multiplied by their opacity, because they were blended into an empty picture.
void SeeThrough::layOver(double opacity) {
  auto* gl = QOpenGLContext::currentContext()->functions();
  if (blitter_ == nullptr) {
    blitter_ = std::make_unique<QOpenGLTextureBlitter>();
    blitter_->create();
  }
  gl->glDisable(GL_DEPTH_TEST);
  gl->glEnable(GL_BLEND);
  gl->glBlendColor(0, 0, 0, float(opacity));
  gl->glBlendFuncSeparate(GL_CONSTANT_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  blitter_->bind();
  blitter_->setOpacity(float(opacity));  // scales the alpha that hides the picture below
  blitter_->blit(picture_->texture(), QMatrix4x4(), QOpenGLTextureBlitter::OriginBottomLeft);
  blitter_->release();
}

void SeeThrough::destroy() {
  picture_.reset();
  blitter_.reset();
}

}  // namespace chainmail

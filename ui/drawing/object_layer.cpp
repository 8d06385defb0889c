#include "drawing/object_layer.h"

#include <QFile>
#include <QMatrix4x4>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <algorithm>

#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr GLint samplesWanted = 4;
// Multisampled pictures with more pixels than this would take too much memory: 16 bytes per sample and pixel.
constexpr qint64 maxPixelsSampled = 16'000'000;

}  // namespace

void buildProgram(QOpenGLShaderProgram& program, const char* vertex, const char* fragment, const QByteArray& head) {
  const auto source = [&head](const char* name) {
    QFile file(QLatin1String(":/shaders/") + QLatin1String(name));
    return file.open(QIODevice::ReadOnly) ? "#version 330 core\n" + head + file.readAll() : QByteArray();
  };
  if (!(program.addShaderFromSourceCode(QOpenGLShader::Vertex, source(vertex)) &&
        program.addShaderFromSourceCode(QOpenGLShader::Fragment, source(fragment)) && program.link())) {
    throw Error("OpenGL", program.log().simplified().toStdString(), "update the graphics driver");
  }
}

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

void ObjectLayer::initialize() {
  initializeOpenGLFunctions();
  buildProgram(occlusion_, "layer.vert", "occlusion.frag");
  buildProgram(copy_, "layer.vert", "copy.frag");
  vertexArray_.create();
}

void ObjectLayer::destroy() {
  release();
  occlusion_.removeAllShaders();
  copy_.removeAllShaders();
  vertexArray_.destroy();
}

void ObjectLayer::release() {
  if (size_.isEmpty()) {
    return;
  }
  glDeleteRenderbuffers(2, sampled_.attachments.data());
  for (Canvas* canvas : {&resolved_, &occluded_}) {
    glDeleteTextures(2, canvas->attachments.data());
  }
  for (Canvas* canvas : {&sampled_, &resolved_, &occluded_}) {
    glDeleteFramebuffers(1, &canvas->framebuffer);
    *canvas = {};
  }
  size_ = {};
}

void ObjectLayer::allocate(QSize size) {
  if (size == size_) {
    return;
  }
  release();
  size_ = size;
  makeSampled(size);
  makeTextured(resolved_, size, GL_RGBA8, true);
  makeTextured(occluded_, {std::max(1, size.width() / 2), std::max(1, size.height() / 2)}, GL_R8, false);
}

void ObjectLayer::makeSampled(QSize size) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  const GLint samples = qint64{size.width()} * size.height() > maxPixelsSampled ? 0 : std::min(samplesWanted, most);
  glGenFramebuffers(1, &sampled_.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.framebuffer);
  glGenRenderbuffers(2, sampled_.attachments.data());
  for (const auto& [buffer, format, attachment] :
       {std::tuple(sampled_.attachments[0], GL_RGBA8, GL_COLOR_ATTACHMENT0),
        std::tuple(sampled_.attachments[1], GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT)}) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GLenum(format), size.width(), size.height());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GLenum(attachment), GL_RENDERBUFFER, buffer);
  }
}

void ObjectLayer::makeTextured(Canvas& canvas, QSize size, GLenum colour, bool withDepth) {
  glGenFramebuffers(1, &canvas.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
  glGenTextures(withDepth ? 2 : 1, canvas.attachments.data());
  const auto attach = [&](GLuint texture, GLenum format, GLenum data, GLenum type, GLint filter, GLenum attachment) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), size.width(), size.height(), 0, data, type, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
  };
  const bool grey = colour == GL_R8;
  attach(canvas.attachments[0], colour, grey ? GL_RED : GL_RGBA, GL_UNSIGNED_BYTE, grey ? GL_LINEAR : GL_NEAREST,
         GL_COLOR_ATTACHMENT0);
  if (withDepth) {
    attach(canvas.attachments[1], GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, GL_NEAREST,
           GL_DEPTH_ATTACHMENT);
  }
}

void ObjectLayer::begin(QSize size) {
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &below_);
  allocate(size);
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.framebuffer);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void ObjectLayer::end(const Occlusion& occlusion) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.framebuffer);
  const int width = size_.width(), height = size_.height();
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  darkening_ = occlusion.reach > 0 ? occlusion.darkening : 0;
  if (darkening_ > 0) {
    darken(occlusion);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, GLuint(below_));
}

void ObjectLayer::darken(const Occlusion& occlusion) {
  const QSize half(std::max(1, size_.width() / 2), std::max(1, size_.height() / 2));
  glBindFramebuffer(GL_FRAMEBUFFER, occluded_.framebuffer);
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  glViewport(0, 0, half.width(), half.height());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  occlusion_.bind();
  const bool perspective = occlusion.toClip(3, 3) == 0;
  occlusion_.setUniformValue("depths", 0);
  occlusion_.setUniformValue("from_clip", occlusion.toClip.inverted());
  occlusion_.setUniformValue("reach", occlusion.reach);
  occlusion_.setUniformValue("pixel_reach", occlusion.reach * occlusion.toClip(1, 1) / 2);
  occlusion_.setUniformValue("aspect", float(size_.width()) / float(size_.height()));
  occlusion_.setUniformValue("perspective", perspective);
  occlusion_.setUniformValue("texel", QVector2D(1 / float(size_.width()), 1 / float(size_.height())));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, resolved_.attachments[1]);
  drawTriangle();
  occlusion_.release();
  glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
}

void ObjectLayer::copy() {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  copy_.bind();
  copy_.setUniformValue("darkening", darkening_);
  const std::array textures{resolved_.attachments[0], resolved_.attachments[1], occluded_.attachments[0]};
  const std::array names{"picture", "depths", "occlusions"};
  for (std::size_t unit = textures.size(); unit-- > 0;) {
    copy_.setUniformValue(names[unit], GLint(unit));
    glActiveTexture(GLenum(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, textures[unit]);
  }
  drawTriangle();
  copy_.release();
  glDepthFunc(GL_LEQUAL);
}

void ObjectLayer::drawTriangle() {
  vertexArray_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  vertexArray_.release();
}

}  // namespace chainmail

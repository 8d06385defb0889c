#pragma once

#include <QOpenGLFunctions>
#include <memory>

#include "mesh/texture.h"

class QOpenGLContextGroup;

namespace chainmail {

/// A texture on the graphics card. It is made and goes while a context of the group that shares it is current.
class CardTexture {
 public:
  explicit CardTexture(const Texture& texture);
  ~CardTexture();
  CardTexture(const CardTexture&) = delete;
  CardTexture& operator=(const CardTexture&) = delete;

  /// For the next that draws: a sampler2D of a picture, a sampler3D of a volume.
  void bind() const;

 private:
  GLenum target_;
  GLuint number_ = 0;
};

/// Sends a mesh's texture to the graphics card once for all that draw it there; it goes with the last of them.
class CardTextures {
 public:
  /// Needs the context current.
  std::shared_ptr<CardTexture> of(const std::shared_ptr<const Texture>& texture);

 private:
  std::weak_ptr<const Texture> texture_;
  std::weak_ptr<CardTexture> onCard_;
  const QOpenGLContextGroup* group_ = nullptr;
};

}  // namespace chainmail

#pragma once

#include <QOpenGLFunctions>
#include <memory>

#include "mesh/texture.h"

class QOpenGLContextGroup;

namespace chainmail {

/// A texture on the graphics card. Constructor and destructor require a context of the same share group to be current.
class CardTexture {
 public:
  explicit CardTexture(const Texture& texture);
  ~CardTexture();
  CardTexture(const CardTexture&) = delete;
  CardTexture& operator=(const CardTexture&) = delete;

  /// Binds the texture for the next draw call: a sampler2D for a picture, a sampler3D for a volume.
  void bind() const;

 private:
  GLenum target_;
  GLuint number_ = 0;
};

/// Sends the texture of a mesh to the graphics card once for all painters. The last painter frees it.
class CardTextures {
 public:
  /// Returns the texture on the graphics card; sends it on first use. Requires the context to be current.
  std::shared_ptr<CardTexture> of(const std::shared_ptr<const Texture>& texture);

 private:
  std::weak_ptr<const Texture> texture_;
  std::weak_ptr<CardTexture> onCard_;
  const QOpenGLContextGroup* group_ = nullptr;
};

}  // namespace chainmail

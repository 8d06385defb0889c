#include "drawing/card_texture.h"

#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <algorithm>
#include <vector>

namespace chainmail {
namespace {

/// Returns a smaller texture with every n-th texel along each axis, so that no axis has more than `most` texels.
Texture reduced(const Texture& texture, std::uint32_t most) {
  const std::uint32_t step = (*std::max_element(texture.size.begin(), texture.size.end()) + most - 1) / most;
  Texture result = texture;
  result.texels.clear();
  for (std::uint32_t& size : result.size) {
    size = (size + step - 1) / step;
  }
  result.texels.reserve(result.byte_count());
  const auto [width, height, depth] = texture.size;
  for (std::uint32_t z = 0; z < depth; z += step) {
    for (std::uint32_t y = 0; y < height; y += step) {
      for (std::uint32_t x = 0; x < width; x += step) {
        const auto* texel =
            texture.texels.data() + (x + std::size_t{width} * (y + std::size_t{height} * z)) * texture.channels;
        result.texels.insert(result.texels.end(), texel, texel + texture.channels);
      }
    }
  }
  return result;
}

QOpenGLExtraFunctions& currentGl() { return *QOpenGLContext::currentContext()->extraFunctions(); }

void sendTexture(GLenum target, const Texture& texture) {
  const auto [width, height, depth] = texture.size;
  const GLint inside = texture.channels == 1 ? GL_R8 : GL_RGBA8;
  const GLenum format = texture.channels == 1 ? GL_RED : GL_RGBA;
  currentGl().glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (target == GL_TEXTURE_2D) {
    currentGl().glTexImage2D(target, 0, inside, GLsizei(width), GLsizei(height), 0, format, GL_UNSIGNED_BYTE,
                             texture.texels.data());
  } else {
    currentGl().glTexImage3D(target, 0, inside, GLsizei(width), GLsizei(height), GLsizei(depth), 0, format,
                             GL_UNSIGNED_BYTE, texture.texels.data());
  }
  currentGl().glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

}  // namespace

CardTexture::CardTexture(const Texture& texture) : target_(texture.size[2] == 1 ? GL_TEXTURE_2D : GL_TEXTURE_3D) {
  GLint most = 0;
  currentGl().glGetIntegerv(target_ == GL_TEXTURE_2D ? GL_MAX_TEXTURE_SIZE : GL_MAX_3D_TEXTURE_SIZE, &most);
  currentGl().glGenTextures(1, &number_);
  currentGl().glBindTexture(target_, number_);
  const bool fits = *std::max_element(texture.size.begin(), texture.size.end()) <= std::uint32_t(most);
  fits ? sendTexture(target_, texture) : sendTexture(target_, reduced(texture, std::uint32_t(most)));
  currentGl().glGenerateMipmap(target_);  // prevents grain if the picture is drawn small
  currentGl().glTexParameteri(target_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  currentGl().glTexParameteri(target_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum along : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    currentGl().glTexParameteri(target_, along, GL_CLAMP_TO_EDGE);
  }
  if (texture.channels == 1) {
    currentGl().glTexParameteri(target_, GL_TEXTURE_SWIZZLE_G, GL_RED);
    currentGl().glTexParameteri(target_, GL_TEXTURE_SWIZZLE_B, GL_RED);
  }
}

CardTexture::~CardTexture() { currentGl().glDeleteTextures(1, &number_); }

void CardTexture::bind() const { currentGl().glBindTexture(target_, number_); }

std::shared_ptr<CardTexture> CardTextures::of(const std::shared_ptr<const Texture>& texture) {
  const auto* group = QOpenGLContext::currentContext()->shareGroup();
  auto found = onCard_.lock();
  if (found == nullptr || texture_.lock() != texture || group_ != group) {
    found = std::make_shared<CardTexture>(*texture);
    onCard_ = found;
    texture_ = texture;
    group_ = group;
  }
  return found;
}

}  // namespace chainmail

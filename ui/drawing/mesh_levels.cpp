#include "drawing/mesh_levels.h"

#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <algorithm>
#include <bit>
#include <mutex>
#include <utility>

namespace chainmail {
namespace {

// The levels of smaller meshes are computed when they are needed, in some milliseconds.
constexpr ElementId minElements = 100'000;

std::mutex mutex;
std::vector<MeshLevelPointer> prepared;  // guarded by the mutex

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

unsigned MeshLevels::after(unsigned step, const Mesh& mesh) {
  const bool power = std::has_single_bit(step);
  return mesh.lattice && step > 1 ? (power ? step * 3 / 2 : step * 4 / 3) : step * 2;
}

double MeshLevels::elementsAt(const Mesh& mesh, unsigned step) {
  if (!mesh.lattice) {
    return mesh.element_count() / std::pow(step, mesh.object_dimension);
  }
  double count = 1;
  for (const double size : mesh.lattice->size) {
    count *= step == 1 || size == 1 ? size : std::floor((size - 2) / step) + 2;
  }
  return count;
}

MeshLevelPointer MeshLevels::at(const MeshPointer& mesh, unsigned step) {
  if (mesh != mesh_) {
    levels_.clear();
    mesh_ = mesh;
    for (const MeshLevelPointer& level : takePreparedLevels(mesh)) {
      levels_[level->step] = level;
    }
  }
  auto& level = levels_[step];
  if (level == nullptr) {
    level = step == 1 ? wholeLevel(mesh) : mesh->lattice ? coarseLattice(mesh, step) : coarser(*at(mesh, step / 2));
  }
  return level;
}

const Surface& MeshLevels::surface(const MeshPointer& mesh, const Cuts& cuts) {
  if (surface_ == nullptr || surface_->table().mesh() != mesh) {
    auto surface = maker_.take(mesh);
    for (const LinkId link : cuts.links()) {
      surface->cut(link);
    }
    surface_ = std::move(surface);
  }
  return *surface_;
}

const Surface* MeshLevels::surfaceIfAny(const MeshPointer& mesh, const Cuts& cuts) {
  return (surface_ != nullptr && surface_->table().mesh() == mesh) || maker_.succeeds(mesh) ? &surface(mesh, cuts)
                                                                                            : nullptr;
}

bool MeshLevels::hasSurface(const MeshPointer& mesh) {
  return (surface_ != nullptr && surface_->table().mesh() == mesh) || maker_.has(mesh);
}

void MeshLevels::showCuts(const std::vector<LinkId>& links, bool cut) {
  if (surface_ == nullptr) {
    return;
  }
  for (const LinkId link : links) {
    cut ? surface_->cut(link) : surface_->uncut(link);
  }
}

const Section& MeshLevels::section(const MeshPointer& mesh, const Cuts& cuts, const SectionPlane& plane) {
  const auto& table = surface(mesh, cuts).table_pointer();
  if (section_ == nullptr || &section_->table() != table.get() || section_->plane() != plane) {
    section_ = std::make_unique<Section>(table, plane);
  }
  return *section_;
}

void MeshLevels::forgetSurface() {
  surface_.reset();
  section_.reset();
}

void prepareLevels(const MeshPointer& mesh, const Progress& progress) {
  if (mesh->element_count() < minElements) {
    return;
  }
  progress.report(0);
  std::vector<MeshLevelPointer> levels{wholeLevel(mesh)};
  // Which one is drawn first depends on the size of the view. The finest are drawn only after a zoom.
  for (unsigned step = 2; step <= MeshLevels::coarsestStep && levels.back()->elements.size() >= minElements;
       step = MeshLevels::after(step, *mesh)) {
    progress.report(double(step) / MeshLevels::coarsestStep);
    if (!mesh->lattice) {
      levels.push_back(coarser(*levels.back()));
    } else if (MeshLevels::elementsAt(*mesh, step) < 10 * minElements) {
      levels.push_back(coarseLattice(mesh, step));
    }
  }
  progress.report(1);  // nothing is kept of a job that was cancelled
  const std::lock_guard lock(mutex);
  prepared = std::move(levels);
}

std::vector<MeshLevelPointer> takePreparedLevels(const MeshPointer& mesh) {
  const std::lock_guard lock(mutex);
  const bool isOfMesh = !prepared.empty() && prepared.front()->mesh == mesh;
  return isOfMesh ? std::exchange(prepared, {}) : std::vector<MeshLevelPointer>();
}

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

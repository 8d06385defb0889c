#pragma once

#include <QOpenGLFunctions>
#include <map>
#include <memory>
#include <vector>

#include "drawing/mesh_level.h"
#include "drawing/surface_maker.h"
#include "mesh/progress.h"
#include "mesh/section.h"
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

/// The data that all painters of one mesh share, created on first use: its levels of detail, outer surface and section.
/// All panels have the same cuts.
class MeshLevels {
 public:
  static constexpr unsigned coarsestStep = 64;
  /// Returns the next coarser step. Steps are powers of two; a lattice has one more step between two powers.
  static unsigned after(unsigned step, const Mesh& mesh);
  /// Returns about how many elements a level has.
  static double elementsAt(const Mesh& mesh, unsigned step);
  /// Returns a level: a prepared one (see prepareLevels), or a new one, which is kept.
  MeshLevelPointer at(const MeshPointer& mesh, unsigned step);

  /// Returns the surface of the mesh's cells; waits if it is still being computed. A new surface has these cuts;
  /// showCuts() updates it later. If it could not be computed, throws the reason.
  const Surface& surface(const MeshPointer& mesh, const Cuts& cuts);
  /// The same, but returns null if it could not be computed.
  const Surface* surfaceIfAny(const MeshPointer& mesh, const Cuts& cuts);
  /// Returns true if surface() would neither wait nor throw. Otherwise SurfaceMaker::made is emitted when the
  /// computation has ended.
  bool hasSurface(const MeshPointer& mesh);
  SurfaceMaker& maker() { return maker_; }
  void showCuts(const std::vector<LinkId>& links, bool cut);
  /// Returns the section of the mesh's cells.
  const Section& section(const MeshPointer& mesh, const Cuts& cuts, const SectionPlane& plane);
  /// Drops surface and section. Call this after the mesh, or all cuts, were replaced.
  void forgetSurface();
  CardTextures& textures() { return textures_; }

 private:
  SurfaceMaker maker_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Section> section_;
  CardTextures textures_;
  MeshPointer mesh_;
  std::map<unsigned, MeshLevelPointer> levels_;
};

/// Computes the levels with which a large mesh will be searched and first drawn. Call this in the job that opens the
/// mesh, so that the window does not wait for them. They are kept until they are taken or those of another mesh are
/// prepared. Throws Cancelled.
void prepareLevels(const MeshPointer& mesh, const Progress& progress);

/// Returns the prepared levels of a mesh, if any, and no longer keeps them.
std::vector<MeshLevelPointer> takePreparedLevels(const MeshPointer& mesh);

}  // namespace chainmail

#pragma once

#include <map>

#include "drawing/card_texture.h"
#include "drawing/coarse_level.h"
#include "drawing/surface_maker.h"
#include "mesh/section.h"

namespace chainmail {

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

}  // namespace chainmail

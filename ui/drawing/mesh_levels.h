#pragma once

#include <bit>
#include <map>

#include "drawing/card_texture.h"
#include "drawing/coarse_level.h"
#include "drawing/surface_maker.h"
#include "mesh/section.h"

namespace chainmail {

/// What panels share of how one mesh at a time is drawn, made when first asked for: its levels of detail, and its outer
/// surface under the cuts that they have in common.
class MeshLevels {
 public:
  /// The next coarser step that there is: powers of two, and on a lattice one between each.
  static unsigned after(unsigned step, const Mesh& mesh) {
    const bool power = std::has_single_bit(step);
    return mesh.lattice && step > 1 ? (power ? step * 3 / 2 : step * 4 / 3) : step * 2;
  }
  /// The whole of the mesh that comes next, as a job has made it meanwhile.
  void await(MeshLevelPointer whole) { next_ = std::move(whole); }
  MeshLevelPointer at(const MeshPointer& mesh, unsigned step) {
    if (mesh != mesh_) {
      levels_.clear();
      mesh_ = mesh;
      levels_[1] = next_ != nullptr && next_->mesh == mesh ? next_ : nullptr;
    }
    auto& level = levels_[step];
    if (level == nullptr) {
      level = step == 1 ? wholeLevel(mesh) : mesh->lattice ? coarseLattice(mesh, step) : coarser(*at(mesh, step / 2));
    }
    return level;
  }

  /// Of its cells, waited for unless it is there; made with the cuts as they are, and told of later ones.
  const Surface& surface(const MeshPointer& mesh, const Cuts& cuts) {
    if (surface_ == nullptr || surface_->table().mesh() != mesh) {
      surface_ = maker_.take(mesh);
      for (const LinkId link : cuts.links()) {
        surface_->cut(link);
      }
    }
    return *surface_;
  }
  /// Whether it is there; SurfaceMaker::made tells when it is.
  bool hasSurface(const MeshPointer& mesh) {
    return (surface_ != nullptr && surface_->table().mesh() == mesh) || maker_.has(mesh);
  }
  SurfaceMaker& maker() { return maker_; }
  void showCuts(const std::vector<LinkId>& links, bool cut) {
    for (const LinkId link : surface_ == nullptr ? std::vector<LinkId>() : links) {
      cut ? surface_->cut(link) : surface_->uncut(link);
    }
  }
  /// The section of its cells.
  const Section& section(const MeshPointer& mesh, const Cuts& cuts, const SectionPlane& plane) {
    const auto& table = surface(mesh, cuts).table_pointer();
    if (section_ == nullptr || &section_->table() != table.get() || section_->plane() != plane) {
      section_ = std::make_unique<Section>(table, plane);
    }
    return *section_;
  }
  CardTextures& textures() { return textures_; }
  /// Another mesh, or other cuts, have taken the place of those that the surface was told of.
  void forgetSurface() {
    surface_.reset();
    section_.reset();
  }

 private:
  SurfaceMaker maker_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Section> section_;
  CardTextures textures_;
  MeshPointer mesh_;
  MeshLevelPointer next_;
  std::map<unsigned, MeshLevelPointer> levels_;
};

}  // namespace chainmail

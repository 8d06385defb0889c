#pragma once

#include <bit>
#include <map>

#include "coarse_level.h"

namespace chainmail {

/// The levels of detail of one mesh at a time, made when first asked for; the panels share them.
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

 private:
  MeshPointer mesh_;
  MeshLevelPointer next_;
  std::map<unsigned, MeshLevelPointer> levels_;
};

}  // namespace chainmail

#include "drawing/mesh_levels.h"

#include <bit>

#include "drawing/prepared_levels.h"

namespace chainmail {

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

}  // namespace chainmail

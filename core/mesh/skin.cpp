#include "mesh/skin.h"

#include <algorithm>

#include "mesh/cells.h"

namespace chainmail {
namespace {

/// Returns the corners of the sides of the surface, and of the triangles that a side of four corners may be divided
/// into. Sorted.
std::vector<Carrier> sides_of_surface(const MeshPointer& mesh) {
  std::vector<Carrier> sides;
  const Carriers old(mesh->element_count());
  const auto add = [&](std::span<const ElementId> corners, ElementId without) {
    std::vector<ElementId> all(corners.begin(), corners.end());
    std::erase(all, without);
    sides.push_back(old.of(all));
  };
  const CellTable table(mesh);
  for (SideId number = 0; number < table.side_count(); ++number) {
    if (table.twin(number) == CellTable::none) {
      const Side side = table.side(number);
      add(side.corners(), no_element);
      for (int i = 0; side.count == 4 && i < 4; ++i) {
        add(side.corners(), side.corner[std::size_t(i)]);
      }
    }
  }
  std::ranges::sort(sides);
  return sides;
}

}  // namespace

Skin::Skin(const MeshPointer& mesh) : first_(std::make_shared<First>()), carriers_(mesh->element_count()) {
  first_->mesh = mesh;
}

std::shared_ptr<const Skin> Skin::after(const MeshPointer& mesh, std::span<const SplitPoint> appended) {
  auto skin = mesh->skin != nullptr ? std::make_shared<Skin>(*mesh->skin) : std::make_shared<Skin>(mesh);
  skin->carriers_.append(appended);
  return skin;
}

bool Skin::contains(std::span<const ElementId> corners) const {
  const std::lock_guard guard(first_->mutex);
  if (!first_->is_found) {
    first_->sides = sides_of_surface(first_->mesh);
    first_->is_found = true;
  }
  return std::ranges::binary_search(first_->sides, carriers_.of(corners));
}

}  // namespace chainmail

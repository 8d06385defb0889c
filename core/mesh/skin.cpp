#include "mesh/skin.h"

#include <algorithm>

#include "mesh/cells.h"

namespace chainmail {
namespace {

Skin::Carrier nowhere() {
  Skin::Carrier carrier;
  carrier.fill(no_element);
  return carrier;
}

/// Inserts an element; the highest of six is lost.
void insert(ElementId element, Skin::Carrier& all) {
  const auto at = std::ranges::lower_bound(all, element);
  if (at != all.end() && *at != element) {
    std::move_backward(at, all.end() - 1, all.end());
    *at = element;
  }
}

/// Returns the corners of the sides of the surface, and of the triangles that a side of four corners may be divided
/// into. Sorted.
std::vector<Skin::Carrier> sides_of_surface(const MeshPointer& mesh) {
  std::vector<Skin::Carrier> sides;
  const auto add = [&](std::span<const ElementId> corners, ElementId without) {
    Skin::Carrier all = nowhere();
    for (const ElementId corner : corners) {
      if (corner != without) {
        insert(corner, all);
      }
    }
    sides.push_back(all);
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

std::shared_ptr<const Skin> Skin::after(const MeshPointer& mesh, std::span<const SplitPoint> appended) {
  auto skin = std::make_shared<Skin>();
  if (mesh->skin != nullptr) {
    *skin = *mesh->skin;
  } else {
    skin->first_ = std::make_shared<First>();
    skin->first_->mesh = mesh;
  }
  for (const SplitPoint& point : appended) {
    skin->carriers_.push_back(skin->carrier_of(point.of));
  }
  return skin;
}

bool Skin::contains(std::span<const ElementId> corners) const {
  const std::lock_guard guard(first_->mutex);
  if (!first_->is_found) {
    first_->sides = sides_of_surface(first_->mesh);
    first_->is_found = true;
  }
  return std::ranges::binary_search(first_->sides, carrier_of(corners));
}

Skin::Carrier Skin::carrier_of(std::span<const ElementId> elements) const {
  Carrier carrier = nowhere();
  const ElementId count = first_->mesh->element_count();
  for (const ElementId element : elements) {
    if (element < count) {
      insert(element, carrier);
    } else {
      std::ranges::for_each(carriers_[element - count], [&](ElementId one) { insert(one, carrier); });
    }
  }
  return carrier;
}

}  // namespace chainmail

#include "equilibrium/fixed_elements.h"

#include <algorithm>
#include <iterator>

namespace chainmail {
namespace {

// An element is at a node if the node's weight is above this.
constexpr double at_node_above = 0.999;

}  // namespace

FixedElements::FixedElements(const CubeSpace& space)
    : space_(space), slot_(space.mesh().element_count(), space.none), is_fixed_(slot_.size(), false) {
  for (int l = 0; l <= space.top(); ++l) {
    at_node_.emplace_back(space.level(l).node_count(), no_element);
    spring_.emplace_back(space.level(l).node_count(), 0.0F);
  }
}

void FixedElements::set(std::span<const ElementId> pins, std::span<const ElementId> held) {
  for (const ElementId e : elements_) {
    slot_[e] = CubeSpace::none;
    is_fixed_[e] = false;
    for (int l = 1; l <= space_.top() && space_.home(e) != CubeSpace::none; ++l) {
      for (const std::uint32_t node : space_.level(l).parts[space_.ancestor(space_.home(e), l)].corner) {
        at_node_[std::size_t(l)][node] = no_element;
        spring_[std::size_t(l)][node] = 0;
      }
    }
  }
  elements_.clear();
  std::ranges::set_union(pins, held, std::back_inserter(elements_));
  held_.assign(held.begin(), held.end());
  displacements_.assign(elements_.size(), Doubles4{});
  is_held_.assign(elements_.size(), 0);
  for (std::uint32_t i = 0; i < elements_.size(); ++i) {
    slot_[elements_[i]] = i;
    is_fixed_[elements_[i]] = true;
    is_held_[i] = std::ranges::binary_search(held, elements_[i]) ? 1 : 0;
  }
  for (const ElementId e : elements_) {
    if (space_.home(e) != CubeSpace::none) {
      fix_nodes(e);
    }
  }
  rim_.clear();
  for (const ElementId e : held) {
    if (is_rim(e)) {
      rim_.push_back(space_.point(e));
    }
  }
}

void FixedElements::fix_nodes(ElementId element) {
  const Point point = space_.point(element);
  std::uint32_t p = space_.home(element);
  for (int l = 1; l <= space_.top(); ++l) {
    const CubeSpace::Level& level = space_.level(l);
    const CubeSpace::Part& part = level.parts[p];
    const auto at = space_.interpolate(point, l, level.cubes[part.cube]);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t node = part.corner[at.corner[i]];
      if (at.weight[i] > at_node_above) {
        at_node_[std::size_t(l)][node] = element;
      } else {
        spring_[std::size_t(l)][node] += float(at.weight[i] * at.weight[i]);
      }
    }
    p = part.parent;
  }
}

/// True if a free neighbour is on the other side than the neighbours that are held.
bool FixedElements::is_rim(ElementId element) const {
  const auto neighbours = space_.mesh().neighbours_of(element);
  const Point here = space_.point(element);
  Point away = Point::Zero();
  double count = 0;
  for (const ElementId other : neighbours) {
    if (is_held(other)) {
      away += here - space_.point(other);
      ++count;
    }
  }
  if (count > 0 && away.norm() < 0.2 * count) {
    return false;
  }
  return std::ranges::any_of(neighbours, [&](ElementId other) {
    const Point apart = space_.point(other) - here;
    return !is_held(other) && (count == 0 || away.dot(apart) > 0.6 * away.norm() * apart.norm());
  });
}

}  // namespace chainmail

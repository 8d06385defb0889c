#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "equilibrium/cube_space.h"
#include "equilibrium/wide_vectors.h"

namespace chainmail {

/// The pinned and the held elements of an object, where they are, and what they mean for the nodes of cubes: a node at
/// a fixed element is fixed too. Where an element is between nodes, a spring of the stiffness of its links pulls the
/// interpolated displacement to its own. Lengths are in units of the space.
class FixedElements {
 public:
  explicit FixedElements(const CubeSpace& space);

  /// Sets which elements are fixed; both are ascending. All displacements become 0. Costs as much as there are such.
  void set(std::span<const ElementId> pins, std::span<const ElementId> held);
  std::span<const ElementId> elements() const { return elements_; }
  std::span<const ElementId> held() const { return held_; }
  bool is_fixed(ElementId element) const { return is_fixed_[element]; }
  bool is_held(ElementId element) const { return is_fixed(element) && is_held_[slot_[element]] != 0; }
  void move(ElementId element, const Doubles4& to) { displacements_[slot_[element]] = to; }
  const Doubles4& displacement(ElementId element) const { return displacements_[slot_[element]]; }

  /// Returns the fixed element at a node of level l, or none.
  ElementId at_node(int l, std::uint32_t node) const { return at_node_[std::size_t(l)][node]; }
  /// Sum of the springs on a node, by the squares of weights, in units of the material's modulus.
  float spring(int l, std::uint32_t node) const { return spring_[std::size_t(l)][node]; }
  /// Where strain is singular: at the elements beside which the handle ends while the object goes on.
  const std::vector<Point>& rim() const { return rim_; }

 private:
  void fix_nodes(ElementId element);
  bool is_rim(ElementId element) const;

  const CubeSpace& space_;
  std::vector<ElementId> elements_, held_;
  std::vector<std::uint32_t> slot_;  // of each element, among the fixed ones
  std::vector<bool> is_fixed_;       // of each element: small enough for the processor's cache
  std::vector<std::uint8_t> is_held_;
  std::vector<Doubles4> displacements_;
  std::vector<std::vector<ElementId>> at_node_;
  std::vector<std::vector<float>> spring_;
  std::vector<Point> rim_;
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <iterator>
#include <numeric>
#include <ostream>
#include <vector>

#include "core/families.h"
#include "property.h"

namespace chainmail {

inline void showValue(const TraceRow& row, std::ostream& out) {
  out << row.element << " by " << row.sponsor << (row.moved ? " moved" : " stayed");
}
inline void showValue(const LinkSoftness& softness, std::ostream& out) {
  out << softness.compression << '/' << softness.stretch << '/' << softness.shear;
}

namespace test {

/// A move of the handle relative to its position, in quarters of a mesh unit: whole numbers shrink well.
struct DragStep {
  std::uint32_t element;  // modulo the number of elements
  int x, y, z;

  ElementId of(const Mesh& mesh) const { return element % mesh.element_count(); }
  Point by() const { return Point(x, y, z) / 4; }
};

inline void showValue(const DragStep& drag_step, std::ostream& out) {
  out << '#' << drag_step.element << " by " << drag_step.by().transpose();
}

inline PassCount move_by(Deformer& solver, const Mesh& mesh, ElementId element, const Point& by,
                         Trace* trace = nullptr) {
  return solver.move(element, position_of(solver, mesh, element) + by, trace);
}

/// Draws moves of up to `reach` quarters of a mesh unit along each axis.
inline rc::Gen<DragStep> any_drag_step(int reach = 20) {
  const auto quarters = rc::gen::inRange(-reach, reach + 1);
  return rc::gen::construct<DragStep>(rc::gen::inRange<std::uint32_t>(0, 1000), quarters, quarters, quarters);
}
inline rc::Gen<std::vector<DragStep>> any_drag_steps(int reach = 20) {
  return rc::gen::container<std::vector<DragStep>>(any_drag_step(reach));
}

/// Draws softness in hundredths, over the accepted and useful range.
inline rc::Gen<LinkSoftness> any_link_softness() {
  return rc::gen::map(rc::gen::tuple(rc::gen::inRange(0, 101), rc::gen::inRange(100, 301), rc::gen::inRange(0, 101)),
                      [](const auto& hundredths) {
                        const auto [compression, stretch, shear] = hundredths;
                        return LinkSoftness{compression / 100.0, stretch / 100.0, shear / 100.0};
                      });
}

/// Draws an algorithm that works on every mesh and processes one candidate after another.
inline rc::Gen<Algorithm> any_algorithm() {
  return rc::gen::element(Algorithm::generalized, Algorithm::spiral, Algorithm::natural_queue, Algorithm::enhanced);
}
inline rc::Gen<Precision> any_precision() {
  return rc::gen::element(Precision::single_precision, Precision::double_precision);
}

/// Draws a mesh, also a degenerate one.
inline const MeshFamily& draw_family() {
  static const std::vector<MeshFamily> all = [] {
    std::vector<MeshFamily> both = families();
    std::ranges::move(degenerate_families(), std::back_inserter(both));
    return both;
  }();
  const MeshFamily& family = all[*rc::gen::inRange<std::size_t>(0, all.size())];
  RC_LOG() << "mesh: " << family.name << '\n';
  return family;
}

/// Draws a lattice without cuts and diagonals, in any space dimension that it fits.
inline MeshPointer draw_grid() {
  static const std::vector<MeshPointer> grids{
      make_mesh(MeshKind::line, {20, 1, 1}),   make_mesh(MeshKind::line, {20, 1, 1}, 3),
      make_mesh(MeshKind::grid, {9, 7, 1}),    make_mesh(MeshKind::grid, {12, 12, 1}, {}, 0.1),
      make_mesh(MeshKind::grid, {8, 8, 1}, 3), make_mesh(MeshKind::block, {5, 4, 4}),
  };
  return grids[*rc::gen::inRange<std::size_t>(0, grids.size())];
}

/// Draws links, the same one perhaps twice; none if there are none.
inline std::vector<LinkId> draw_links(const Mesh& mesh) {
  return mesh.link_count() == 0
             ? std::vector<LinkId>()
             : *rc::gen::container<std::vector<LinkId>>(rc::gen::inRange<LinkId>(0, mesh.link_count()));
}
/// Returns one link, chosen by any number; none if there are none.
inline std::vector<LinkId> one_link(const Mesh& mesh, std::uint32_t which) {
  return mesh.link_count() == 0 ? std::vector<LinkId>() : std::vector<LinkId>{which % mesh.link_count()};
}

/// Draws a softness for all links, and others for some of them.
inline Softness draw_softness(const Mesh& mesh) {
  Softness softness{*any_link_softness(), {}};
  for (const LinkId link : draw_links(mesh)) {
    softness.links.set(link, *any_link_softness());
  }
  return softness;
}

/// Draws elements to pin; sometimes all.
inline std::vector<ElementId> draw_pins(const Mesh& mesh) {
  std::vector<ElementId> all(mesh.element_count());
  std::iota(all.begin(), all.end(), 0);
  return *rc::gen::inRange(0, 8) == 0
             ? all
             : *rc::gen::container<std::vector<ElementId>>(rc::gen::inRange<ElementId>(0, mesh.element_count()));
}

}  // namespace test
}  // namespace chainmail

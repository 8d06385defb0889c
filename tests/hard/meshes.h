#pragma once

#include "hard/scene.h"

namespace chainmail::hard {

inline MeshPointer make_grid(std::uint32_t width, std::uint32_t height) {
  return test::make_mesh(MeshKind::grid, {width, height, 1});
}
inline MeshPointer make_chain(std::uint32_t length) { return test::make_mesh(MeshKind::line, {length, 1, 1}); }

/// A grid in which every element has a twin at the same position, linked to it.
MeshPointer doubled_grid(std::uint32_t side);
/// A grid far from the origin.
MeshPointer far_grid(std::uint32_t side, double origin, double spacing);
/// A chain whose links are 1e-6 to 1e6 long, each ten times its neighbour, first growing and then shrinking.
MeshPointer decades_chain();
/// One element in the middle of all others, at random distances of about 1.
MeshPointer star(std::uint32_t arms);
/// Random points in a cube, with links between all of them.
MeshPointer complete_graph(std::uint32_t count);
/// Tetrahedra, some of them almost flat and some inverted: points are moved from the lattice by up to 1.2.
MeshPointer slivers(std::uint32_t side);

/// A grid of 16x16 turned by 45° about the origin. 3D ChainMail does not accept it as a grid.
MeshPointer turned_grid();
/// Drags the grid, then drags it with object and move turned. The drift is the difference between the two answers. It
/// is not 0, because valid regions are boxes along the axes.
Outcome turned(const Contender& contender, Precision precision);

}  // namespace chainmail::hard

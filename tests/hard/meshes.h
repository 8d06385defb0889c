#pragma once

#include "hard/scene.h"

namespace chainmail::hard {

inline MeshPointer make_grid(std::uint32_t width, std::uint32_t height) {
  return test::make_mesh(MeshKind::grid, {width, height, 1});
}
inline MeshPointer make_chain(std::uint32_t length) { return test::make_mesh(MeshKind::line, {length, 1, 1}); }

/// A grid in which every element has a twin in the same place, linked to it.
MeshPointer doubled_grid(std::uint32_t side);
/// A grid far from the origin.
MeshPointer far_grid(std::uint32_t side, double origin, double spacing);
/// A chain whose links are 1e-6 to 1e6 long, a decade apart, there and back.
MeshPointer decades_chain();
/// One element in the middle of all others, at random distances about 1.
MeshPointer star(std::uint32_t arms);
/// Random points in a cube, each linked to each.
MeshPointer complete_graph(std::uint32_t count);
/// Tetrahedra of which some are almost flat and some inside out: points off their places by up to 1.2.
MeshPointer slivers(std::uint32_t side);

/// A grid of 16x16 turned by 45° about the origin; to 3D ChainMail it is none.
MeshPointer turned_grid();
/// A drag of the grid and the same drag with object and hand turned: the drift is the difference between the
/// answers. Boxes follow the axes, so there is one.
Outcome turned(Algorithm algorithm, Precision precision);

}  // namespace chainmail::hard

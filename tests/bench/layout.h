#pragma once

#include <cstddef>

#include "solve/body.h"

namespace chainmail::bench {

/// What the solver holds, in float: the one place in the benchmarks that knows it.

/// The bytes that a whole-body pass must touch at least once.
struct PassBytes {
  std::size_t state = 0;  // read and written: each element's position and stamp
  std::size_t table = 0;  // read: the neighbour table, first_entry and neighbours
};

inline PassBytes pass_bytes(const Mesh& mesh) {
  const std::size_t element = mesh.space_dimension == 2 ? sizeof(Place<float, 2>) : sizeof(Place<float, 3>);
  return {mesh.element_count() * (element + sizeof(std::uint32_t)),
          mesh.first_entry.size() * sizeof(EntryId) + mesh.neighbours.size() * sizeof(ElementId)};
}

/// All that is held of an object but its neighbour table: positions, stamps, regions, rest positions.
inline std::size_t state_bytes(const Mesh& mesh) {
  const std::size_t region = mesh.space_dimension == 2 ? sizeof(Region<float, 2>) : sizeof(Region<float, 3>);
  // One softness: a region a rest vector and its number for each entry, or, with many, a region an entry.
  const std::size_t regions = mesh.entry_shape.empty() ? mesh.neighbours.size() * region
                                                       : mesh.shapes.size() / mesh.space_dimension * region +
                                                             mesh.entry_shape.size() * sizeof(std::uint16_t);
  return pass_bytes(mesh).state + regions + mesh.rest.size() * sizeof(double);
}

}  // namespace chainmail::bench

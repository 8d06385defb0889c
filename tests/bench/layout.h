#pragma once

#include <cstddef>

#include "solve/body.h"
#include "solve/replay.h"

namespace chainmail::bench {

/// What the solver holds, in float: the one place in the benchmarks that knows it.

/// The bytes that a whole-body pass touches, each counted once.
struct PassBytes {
  std::size_t updated = 0;  // read and written
  std::size_t read = 0;
  std::size_t written = 0;

  std::size_t all() const { return updated + read + written; }
};

inline std::size_t place_bytes(const Mesh& mesh) {
  return mesh.element_count() * (mesh.space_dimension == 2 ? sizeof(Position<float, 2>) : sizeof(Position<float, 3>));
}
inline std::size_t region_bytes(const Mesh& mesh) {
  return mesh.space_dimension == 2 ? sizeof(Region<float, 2>) : sizeof(Region<float, 3>);
}

/// A later pass of Natural Queue replays the pass before: it reads a step for each element and updates its position.
/// Where each link has a region of its own, it also reads one region for each element.
inline PassBytes replay_bytes(const Mesh& mesh) {
  const std::size_t regions = mesh.entry_shape.empty() ? mesh.element_count() * region_bytes(mesh) : 0;
  return {place_bytes(mesh), mesh.element_count() * sizeof(Step) + regions, 0};
}

/// A later pass of Exact reads the id of each element and its region about the handle, updates its position and writes
/// its id into the list of those that moved.
inline PassBytes exact_bytes(const Mesh& mesh) {
  const std::size_t ids = mesh.element_count() * sizeof(ElementId);
  return {place_bytes(mesh), ids + mesh.element_count() * region_bytes(mesh), ids};
}

/// All that a solver holds of an object: positions, stamps, steps, regions, rest positions and the neighbour table.
inline std::size_t held_bytes(const Mesh& mesh) {
  // With one softness: a region for each rest vector and its number for each entry; else a region for each entry.
  const std::size_t regions = mesh.entry_shape.empty()
                                  ? mesh.neighbours.size() * region_bytes(mesh)
                                  : mesh.shapes.size() / std::size_t(mesh.space_dimension) * region_bytes(mesh) +
                                        mesh.entry_shape.size() * sizeof(std::uint16_t);
  return place_bytes(mesh) + mesh.element_count() * (sizeof(std::uint32_t) + sizeof(Step)) + regions +
         mesh.rest.size() * sizeof(double) + mesh.first_entry.size() * sizeof(EntryId) +
         mesh.neighbours.size() * sizeof(ElementId);
}

}  // namespace chainmail::bench

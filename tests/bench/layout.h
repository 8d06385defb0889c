#pragma once

#include <cstddef>

#include "body/positions.h"
#include "chainmail/replay.h"

namespace chainmail::bench {

// The size of a solver's data, in float. No other file of the benchmarks depends on its layout.

/// Number of bytes that a whole-body pass touches, each counted once.
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

/// Returns the bytes of a later pass of Natural Queue. It replays the previous pass: reads a step per element and
/// updates the element's position. If each link has its own region, it also reads one region per element.
inline PassBytes replay_bytes(const Mesh& mesh) {
  const std::size_t regions = mesh.entry_shape.empty() ? mesh.element_count() * region_bytes(mesh) : 0;
  return {place_bytes(mesh), mesh.element_count() * sizeof(Step) + regions, 0};
}

/// Returns the bytes of a later pass of Exact. It reads the id of each element and its region about the handle, updates
/// its position and writes its id into the list of moved elements.
inline PassBytes exact_bytes(const Mesh& mesh) {
  const std::size_t ids = mesh.element_count() * sizeof(ElementId);
  return {place_bytes(mesh), ids + mesh.element_count() * region_bytes(mesh), ids};
}

/// Returns the bytes of all data that a solver stores for an object: positions, stamps, steps, regions, rest positions
/// and the neighbour table.
inline std::size_t held_bytes(const Mesh& mesh) {
  // With one softness: one region per rest vector, and its number per entry. Otherwise one region per entry.
  const std::size_t regions = mesh.entry_shape.empty()
                                  ? mesh.neighbours.size() * region_bytes(mesh)
                                  : mesh.shapes.size() / std::size_t(mesh.space_dimension) * region_bytes(mesh) +
                                        mesh.entry_shape.size() * sizeof(std::uint16_t);
  return place_bytes(mesh) + mesh.element_count() * (sizeof(std::uint32_t) + sizeof(Step)) + regions +
         mesh.rest.size() * sizeof(double) + mesh.first_entry.size() * sizeof(EntryId) +
         mesh.neighbours.size() * sizeof(ElementId);
}

}  // namespace chainmail::bench

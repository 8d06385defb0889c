#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Counts of flaws in the mesh of a file that are not errors.
struct MeshFlaws {
  // Flaws that are left out:
  std::uint64_t unused = 0;     // unused points that a library leaves out
  std::uint64_t collapsed = 0;  // faces and cells that use a point twice, or fewer than 3; their edges are still links
  std::uint64_t doubled = 0;    // duplicate faces and cells
  // Flaws that are kept:
  std::uint64_t flat = 0;        // faces without an area, cells without a volume
  std::uint64_t inverted = 0;    // cells inside out
  std::uint64_t coincident = 0;  // elements at the position of another element
  // What the reader changed:
  std::uint64_t divided = 0;  // cells and faces that were divided into others
  std::uint64_t skipped = 0;  // lines that the format does not have, left out
  std::uint64_t joined = 0;   // points that became one with another beside them

  bool operator==(const MeshFlaws&) const = default;
};

/// Removes and counts faces and cells that use a point twice, and duplicates of others.
void leave_out_flawed(MeshParts& parts, MeshFlaws& flaws);

/// Returns, for each element, the lowest id at exactly its rest position: its own id, unless it is a duplicate.
std::vector<ElementId> first_at_position(const Mesh& mesh);

/// Returns the cells that are inside out: tetrahedra by their index, then hexahedra.
std::vector<std::uint32_t> cells_inside_out(const Mesh& mesh);

/// Counts the flaws that a mesh keeps.
void count_flaws(const Mesh& mesh, MeshFlaws& flaws);

/// Describes the flaws in a sentence without a full stop; empty if there are none.
std::string in_words(const MeshFlaws& flaws);

}  // namespace chainmail

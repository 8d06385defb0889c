#pragma once

#include <cstdint>
#include <string>

#include "mesh/mesh.h"

namespace chainmail {

/// What is wrong with a file's mesh without being an error.
struct MeshFlaws {
  // Left out.
  std::uint64_t unused = 0;     // points that nothing uses, and a library does not give
  std::uint64_t collapsed = 0;  // faces and cells that name a point twice: their edges are links all the same
  std::uint64_t doubled = 0;    // faces and cells that are there twice
  // Kept.
  std::uint64_t flat = 0;        // faces without an area, cells without a volume
  std::uint64_t inverted = 0;    // cells inside out
  std::uint64_t coincident = 0;  // elements that stand where another does

  bool operator==(const MeshFlaws&) const = default;
};

/// Takes out of the parts what names a point twice or is there twice, and adds up what was.
void leave_out_flawed(MeshParts& parts, MeshFlaws& flaws);

/// Counts what is flawed in a mesh, and stays.
void count_flaws(const Mesh& mesh, MeshFlaws& flaws);

/// In words, as a sentence without its end, or empty: '2 doubled faces or cells left out, 1 flat'.
std::string in_words(const MeshFlaws& flaws);

}  // namespace chainmail

#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "files/formats/volume.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Why the import program gave nothing, in the words of Error: what is wrong, what to do.
struct Refusal {
  std::string problem;
  std::string remedy;
};

/// A mesh as a file has it: faces and cells may be flat or doubled, and `parts.links` are its lines alone.
struct ImportedMesh {
  MeshParts parts;
  std::uint64_t unused = 0;  // points of the file that nothing uses, and that are left out
};

/// A face of so many corners: two are a line.
void add_face(MeshParts& parts, std::span<const ElementId> corners);

/// What the import program hands over on its way through a pipe.
using Imported = std::variant<ImportedMesh, Volume, Refusal>;

/// The bytes of one: a mark, what it is, counts, then numbers in the machine's own layout, as both programs run on it.
std::vector<std::byte> encode_imported(const Imported& imported);

/// What the bytes hold. Every count is checked against their number before memory is taken, and every id against the
/// number of elements. Throws Error, said of `path`, the file that was read, where they are damaged, a coordinate is
/// not finite or beyond coordinate_limit, or there are more than element_limit elements.
Imported decode_imported(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace chainmail

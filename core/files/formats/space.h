#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mesh/mesh.h"
#include "solver/deformer.h"

namespace chainmail {

/// A value that a comment of a file states, and its line.
template <class Value>
struct Stated {
  Value value;
  std::size_t line;
};

/// Returns the number of axes along which the positions differ, at least 1.
int extent_dimension(const Mesh& mesh, const PositionView& positions);

/// Returns the line `# space N` if the mesh has more dimensions than a reader can derive from these positions, else an
/// empty text.
std::string space_comment(const Mesh& mesh, const PositionView& positions);

/// Returns the space dimension for the mesh: `asked`, else the one that the file states. Throws Error, with the line in
/// the file, if the stated one is too small for the object.
std::optional<int> chosen_space(const MeshParts& parts, std::optional<int> asked,
                                const std::optional<Stated<int>>& stated, const std::filesystem::path& path);

}  // namespace chainmail

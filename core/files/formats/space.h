#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mesh/mesh.h"
#include "solve/solver.h"

namespace chainmail {

/// A value that a comment of a file states, and its line.
template <class Value>
struct Stated {
  Value value;
  std::size_t line;
};

/// Number of axes along which the positions differ, at least 1.
int extent_dimension(const Mesh& mesh, const PositionView& positions);

/// Returns the line `# space N` if the mesh has more dimensions than a reader of these positions would find, else
/// nothing.
std::string space_comment(const Mesh& mesh, const PositionView& positions);

/// Returns the space dimension to build with: the one asked for, else the one that the file states. Throws Error at the
/// line that states it if it would flatten the object.
std::optional<int> chosen_space(const MeshParts& parts, std::optional<int> asked,
                                const std::optional<Stated<int>>& stated, const std::filesystem::path& path);

}  // namespace chainmail

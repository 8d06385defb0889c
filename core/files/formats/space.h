#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mesh/mesh.h"
#include "solve/solver.h"

namespace chainmail {

/// Something that a comment states, and the line that does.
template <class Value>
struct Stated {
  Value value;
  std::size_t line;
};

/// How many axes the positions are not constant on, at least one.
int extent_dimension(const Mesh& mesh, const PositionView& positions);

/// The line `# space N` where the mesh lives in more dimensions than a reader of these positions would
/// see, else nothing.
std::string space_comment(const Mesh& mesh, const PositionView& positions);

/// The space dimension to build with: the one asked for, else the one that the file states. Throws Error
/// at the line that states it where that one would flatten the object.
std::optional<int> chosen_space(const MeshParts& parts, std::optional<int> asked,
                                const std::optional<Stated<int>>& stated, const std::filesystem::path& path);

}  // namespace chainmail

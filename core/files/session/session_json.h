#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

inline constexpr unsigned session_version = 1;

/// A session's JSON. Its long arrays of numbers stand beside the tree, packed, in the order in which they come: in the
/// tree, in place of each, is its number there. The recorded moves stay in the text, where they are to be read for the
/// mesh.
struct SessionJson {  // NOLINT(bugprone-exception-escape): moving a tree throws nothing, which its library does not say
  nlohmann::json tree;
  std::vector<std::vector<std::uint32_t>> ids;
  std::vector<std::vector<double>> reals;
  std::string_view moves;  // the array or object of this name, in the text that was parsed; in the tree it is null
};

/// Throws Error where the text is no JSON, where an array of ids or numbers holds something else, where a key stands
/// twice, and, before it looks at what follows, where the version is newer than session_version; and Cancelled.
SessionJson parse_session_json(std::string_view text, const std::filesystem::path& path, const Progress& progress);

}  // namespace chainmail

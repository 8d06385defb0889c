#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "files/mesh/mesh_formats.h"

namespace chainmail {

/// The format that the beginning of a file's content tells, if any does: names mislead.
std::optional<MeshFormat> format_in(std::string_view beginning);

/// The format of a file: as its content tells, else as its ending names. Throws Error where there is no such file, or
/// neither tells.
MeshFormat detect_format(const std::filesystem::path& path);

}  // namespace chainmail

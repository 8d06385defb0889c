#pragma once

#include <filesystem>

#include "files/formats/imported.h"

namespace chainmail::import {

/// Reads the surface that the caller of a task gives, as encode_imported writes it.
ImportedMesh read_surface(const std::filesystem::path& path);

}  // namespace chainmail::import

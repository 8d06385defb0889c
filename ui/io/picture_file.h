#pragma once

#include <cstdint>

#include "files/text/regular_file.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Number of elements along the width of a picture.
inline constexpr std::uint32_t elementsAcross = 32;

/// Reads a picture, with the rotation that the camera stored, and makes a sheet of it. It can run on any thread. Throws
/// Error if the file is not a PNG or JPEG by its signature, has more than 100 million pixels or is damaged, and
/// Cancelled.
MeshPointer readSheet(RegularFile file, std::uint32_t across, const Progress& progress);

}  // namespace chainmail

#pragma once

#include <filesystem>
#include <ostream>
#include <string_view>

#include "files/formats/imported.h"
#include "files/formats/mesh_state.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads STL, text or binary (3D Systems 1988). A file whose length is that of its number of facets is binary, whatever
/// its header says; otherwise one that begins with `solid` is text, in upper or lower case, behind blank lines,
/// comments and a byte order mark.
///
/// The format has no points of its own: corners at equal positions are one element. Programs write them with different
/// rounding, so corners within 1e-7 of the extent are one element, too. Normals, names and attributes are not read.
/// Throws Error, with the line or the number of the facet, and Cancelled.
ImportedMesh read_stl(std::string_view bytes, const std::filesystem::path& path, const Progress& progress);

/// Writes the faces, divided into triangles, as text with all digits. The boundary of cells counts as faces; links
/// along no face are not in the file.
void write_stl(std::ostream& out, const MeshState& state, const Progress& progress);

}  // namespace chainmail

#pragma once

#include <ostream>

#include "files/mesh_file.h"

namespace chainmail {

/// Writes ASCII PLY (Turk 1994): vertices in double, the faces none of whose links is cut, and the other uncut links
/// as elements `edge` of vertex1 and vertex2.
void write_ply(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail

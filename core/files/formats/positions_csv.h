#pragma once

#include <ostream>

#include "files/formats/mesh_state.h"
#include "mesh/progress.h"

namespace chainmail {

/// Writes CSV `id,x,y,z`: one row per element, with enough digits to read back the same numbers.
void write_positions_csv(std::ostream& out, const MeshState& state, const Progress& progress = {});

}  // namespace chainmail

#pragma once

#include <ostream>

#include "mesh/mesh.h"
#include "solve/solver.h"

namespace chainmail {

/// CSV `id,x,y,z`, a row an element, with enough digits to read back the same numbers.
void write_positions_csv(std::ostream& out, const Mesh& mesh, const PositionView& positions,
                         const Progress& progress = {});

}  // namespace chainmail

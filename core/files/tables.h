#pragma once

#include <ostream>
#include <vector>

#include "mesh/mesh.h"
#include "solve/solver.h"

namespace chainmail {

/// CSV `id,x,y,z`, a row an element, with enough digits to read back the same numbers.
void write_positions_csv(std::ostream& out, const Mesh& mesh, const PositionView& positions,
                         const Progress& progress = {});

/// CSV `pass,order,element,sponsor,moved`: every candidate of every pass, in order. Passes and orders
/// count from 0; moved is 1 or 0; where there is no sponsor it is -1.
void write_trace_csv(std::ostream& out, const std::vector<Trace>& passes);

}  // namespace chainmail

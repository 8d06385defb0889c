#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Fills the table of rest vectors of a mesh that has few: the distinct ones, and which one each entry of the
/// neighbour table has. A mesh with more than Mesh::shape_limit of them keeps both tables empty.
void number_shapes(Mesh& mesh, const Progress& progress);

}  // namespace chainmail

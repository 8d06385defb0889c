#pragma once

#include "drawing/mesh_level.h"

namespace chainmail {

/// Returns a level of a lattice mesh: every `step`-th row and the last row along each axis.
MeshLevelPointer coarseLattice(const MeshPointer& mesh, unsigned step);

/// Returns the next coarser level of any mesh. Its elements are elements of `finer` that are not linked to each other;
/// each represents its neighbours. Its step is twice that of `finer`, because its links are slightly more than two
/// links of `finer` long.
MeshLevelPointer coarser(const MeshLevel& finer);

}  // namespace chainmail

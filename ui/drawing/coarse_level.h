#pragma once

#include "drawing/mesh_level.h"

namespace chainmail {

/// Returns a level of a mesh on a lattice: every step-th row and the last one, along each axis.
MeshLevelPointer coarseLattice(const MeshPointer& mesh, unsigned step);

/// Returns the next coarser level of any mesh: elements of `finer`, no two of them linked, each of which represents its
/// neighbours. Its step is twice that of `finer`, because its links are slightly more than two links of `finer` long.
MeshLevelPointer coarser(const MeshLevel& finer);

}  // namespace chainmail

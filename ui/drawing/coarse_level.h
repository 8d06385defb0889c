#pragma once

#include "drawing/mesh_level.h"

namespace chainmail {

/// Of a mesh on a lattice: every step-th row and the last, along each axis.
MeshLevelPointer coarseLattice(const MeshPointer& mesh, unsigned step);

/// Of any mesh, from a level of it: elements of that level no two of which are linked, each standing for those about
/// it. Its step is twice the other's, as its links are two of the other's long and a little more.
MeshLevelPointer coarser(const MeshLevel& finer);

}  // namespace chainmail

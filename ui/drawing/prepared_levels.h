#pragma once

#include <vector>

#include "drawing/mesh_level.h"
#include "mesh/progress.h"

namespace chainmail {

/// Computes the levels with which a large mesh will be searched and first drawn. Call this in the job that opens the
/// mesh, so that the window does not wait for them. They are kept until they are taken or those of another mesh are
/// prepared. Throws Cancelled.
void prepareLevels(const MeshPointer& mesh, const Progress& progress);

/// Returns the prepared levels of a mesh, if any, and no longer keeps them.
std::vector<MeshLevelPointer> takePreparedLevels(const MeshPointer& mesh);

}  // namespace chainmail

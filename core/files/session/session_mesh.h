#pragma once

#include "files/session/object_json.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Reads the mesh of a session from its member `mesh`. Throws Error, and Cancelled.
MeshPointer read_session_mesh(const ObjectFields& fields, const nlohmann::json& object, const Progress& progress);

}  // namespace chainmail

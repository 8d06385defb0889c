#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "chainmail/body.h"
#include "chainmail/job.h"
#include "chainmail/mesh.h"

namespace chainmail::api {

/// True if a file has the ending of a session of the workbench (`.chainmail`), in upper or lower case.
bool is_session(const std::filesystem::path& path);

/// Opens the mesh or the picture that a session names instead of containing it. The name has no folder.
using SessionMeshOpener = std::function<Mesh(const std::string& name)>;
/// Reads the object of a session, with cuts, pins, softness and elasticity, at the positions of its first panel, in
/// double precision. Without `open`, a session that names its mesh is refused. Throws Error, with the member, if the
/// file is damaged or of a newer version, or if the library was built without nlohmann/json; and Cancelled.
Body read_session(const std::filesystem::path& path, const SessionMeshOpener& open = {}, const Job& job = {});

}  // namespace chainmail::api

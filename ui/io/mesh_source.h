#pragma once

#include <QString>

#include "files/session/session.h"

namespace chainmail {

/// Returns what opens the meshes and pictures that a session names: in the folder of the session, or among the samples.
MeshOpener meshesNear(const QString& session);

}  // namespace chainmail

#pragma once

#include <QString>

#include "files/session/session.h"

namespace chainmail {

/// Number of elements along the width of a picture.
inline constexpr std::uint32_t elementsAcross = 32;

/// Returns what opens the meshes and pictures that a session names: in the folder of the session, or among the samples.
MeshOpener meshesNear(const QString& session);

}  // namespace chainmail

#pragma once

#include <QString>

#include "files/mesh/open_mesh.h"

namespace chainmail {

/// What there is to say of an object that was opened: how much of it there is, how large it is, and what is flawed.
QString openingReport(const QString& name, const OpenedMesh& opened, std::size_t parts);

}  // namespace chainmail

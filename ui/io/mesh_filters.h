#pragma once

#include <QStringList>

#include "files/mesh/mesh_formats.h"

namespace chainmail {

/// What a file dialog offers for saving, a filter a format; those that hold no positions only for what stands in a
/// lattice.
QStringList saveFilters(FormatUse use, bool lattice = false);

/// What a file dialog offers for opening: sessions, all meshes and pictures, one filter.
QString openFilter();

}  // namespace chainmail

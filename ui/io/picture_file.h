#pragma once

#include <QString>

#include "mesh/progress.h"
#include "mesh/texture.h"

namespace chainmail {

/// Pictures in PNG and JPEG files. Both functions can run on any thread.

/// True if the extension or the content of a file is that of a PNG or JPEG.
bool isPicture(const QString& path);

/// Reads a picture with four channels, the bottom row first, with the rotation that the camera stored. It has no box:
/// make_sheet() sets one. Throws Error if the file is not a PNG or JPEG by its signature, has more than 100 million
/// pixels or is damaged, and Cancelled.
Texture readPictureFile(const QString& path, const Progress& progress = {});

}  // namespace chainmail

#pragma once

#include <QImage>
#include <QSize>
#include <QString>

#include "mesh/progress.h"
#include "mesh/texture.h"

namespace chainmail {

/// Pictures in PNG and JPEG files. All functions can run on any thread.

/// True if the extension or the content of a file is that of a PNG or JPEG.
bool isPicture(const QString& path);

/// Returns the size of a picture in pixels, with the rotation that the camera stored; decodes only the header. Throws
/// Error if the file is not a PNG or JPEG by its signature, is not complete, or has more than picture_limit pixels.
QSize pictureSize(const QString& path);

/// Reads a picture with four channels, the bottom row first. It has no box: make_sheet() sets one. Throws Error if it
/// is damaged, and Cancelled.
Texture readPictureFile(const QString& path, const Progress& progress = {});

/// Writes a PNG or JPEG, by the extension of the path, completely or not at all. JPEG has no transparency, so the
/// background becomes white. Throws Error, and Cancelled.
void writePictureFile(const QString& path, const Texture& picture, const Progress& progress = {});

}  // namespace chainmail

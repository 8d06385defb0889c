#pragma once

#include <QImage>
#include <QSize>
#include <QString>

#include "mesh/progress.h"
#include "mesh/texture.h"

namespace chainmail {

/// Pictures in files, PNG or JPEG, read and written on any thread. Nothing of the window's is touched.

/// Whether a file is named like a picture, or is one by what it holds.
bool isPicture(const QString& path);

/// How many pixels a picture has, turned as its camera says; only the file's head is looked at. Throws Error where it
/// is none, or has more than picture_limit.
QSize pictureSize(const QString& path);

/// The whole picture with four channels, its rows upward. Throws Error where it is damaged, and Cancelled.
Texture readPictureFile(const QString& path, const Progress& progress = {});

/// Writes it, a PNG or a JPEG by the path's ending, whole or not at all. JPEG knows no transparency: white shines
/// through. Throws Error, and Cancelled.
void writePictureFile(const QString& path, const Texture& picture, const Progress& progress = {});

}  // namespace chainmail

#pragma once

#include <QString>
#include <span>

#include "common/colours.h"

namespace chainmail {

/// A file in the folder meshes that the gallery shows. Its thumbnails are the resources samples/FILE.png and
/// samples/light/FILE.png, made by the target `thumbnails`.
struct Sample {
  const char* file;
  const char* title;  // one or two words below the thumbnail
  const char* what;
  unsigned elements;  // number of elements; for a picture, of a sheet with the default size
};

/// Returns all samples, in the order of the gallery.
std::span<const Sample> samples();

/// Returns the folder of the samples: installed with the program, or in its source tree. Returns an empty string if
/// there is none.
QString samplesFolder();

/// A lesson: a session with captions, in the folder lessons.
struct LessonFile {
  const char* file;
  const char* title;  // as in the file
};

/// Returns the bundled lessons, in the order of the menu.
std::span<const LessonFile> lessonFiles();

/// Returns the folder of the lessons: installed with the program, or in its source tree. Returns an empty string if
/// there is none.
QString lessonsFolder();

/// True if a file is in one of these folders. Such files are not overwritten and not listed as recent.
bool isSample(const QString& path);

/// Returns the name of a sample's thumbnail for a background, as a resource and as a file.
QString thumbnailOf(const Sample& sample, colours::Ground ground);

}  // namespace chainmail

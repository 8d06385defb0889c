#pragma once

#include <QString>
#include <span>

namespace chainmail {

/// A file of the folder meshes that the gallery offers. Its thumbnail is the resource samples/FILE.png, which the
/// target `thumbnails` makes.
struct Sample {
  const char* file;
  const char* title;  // a word or two: it stands below a thumbnail
  const char* what;
  unsigned elements;  // those of a picture as a sheet of the size offered first
};

/// Every one, in the order in which they are offered.
std::span<const Sample> samples();

/// Where they lie: installed beside the program, or in the source that it was built from; empty where they do not.
QString samplesFolder();

/// Whether a file is in that folder: nobody's own, to be saved over.
bool isSample(const QString& path);

/// The resource, or the name of the file, of a sample's thumbnail.
QString thumbnailOf(const Sample& sample);

}  // namespace chainmail

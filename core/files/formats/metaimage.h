#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/formats/volume.h"
#include "files/text/regular_file.h"
#include "mesh/progress.h"

namespace chainmail {

/// The header of a MetaImage file (.mha, .mhd): lines `Key = Value`, ending with ElementDataFile.
struct MetaImageHead {
  std::array<std::uint64_t, 3> size{};
  Point spacing = Point::Ones();
  Point origin = Point::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // see Volume
  std::string type;                                    // type of the numbers: MET_UCHAR, MET_SHORT, …
  bool big_endian = false;
  bool compressed = false;              // true: compressed by zlib
  std::vector<std::string> data_files;  // each with the same number of voxels; none: the data follow the header
  std::uint64_t skipped = 0;            // bytes before the data in each of their files
  bool at_end = false;                  // true: the data are at the end of their file, whatever is before them
  std::size_t length = 0;               // length of the header (bytes)
};

/// Reads the header at the beginning of a file. Throws Error with the line.
MetaImageHead read_metaimage_head(std::string_view text, const std::filesystem::path& path);

/// Returns the volume of a header and its data. Throws Error if they do not match, and Cancelled. Memory is taken for
/// the volume only: the data are read in pieces.
Volume metaimage_volume(const MetaImageHead& head, std::span<const char> data, const std::filesystem::path& path,
                        const Progress& progress = {});

/// Reads a .mha, or a .mhd and its data files, which must be in its folder unless `outside` is true.
Volume read_metaimage(RegularFile file, bool outside, const Progress& progress = {});

}  // namespace chainmail

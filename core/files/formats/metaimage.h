#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "files/formats/volume.h"
#include "mesh/progress.h"

namespace chainmail {

/// The head of a MetaImage file (.mha, .mhd), as lines `Key = Value` in which ElementDataFile comes last.
struct MetaImageHead {
  std::array<std::uint64_t, 3> size{};
  Point spacing = Point::Ones();
  Point origin = Point::Zero();
  std::string type;  // of a number: MET_UCHAR, MET_SHORT, …
  bool big_endian = false;
  bool compressed = false;  // by zlib
  std::string data_file;    // LOCAL: behind the head
  std::size_t length = 0;   // of the head (bytes), after which local data begin
};

/// Reads the head at the beginning of a file. Throws Error with the line.
MetaImageHead read_metaimage_head(std::string_view text, const std::filesystem::path& path);

/// The volume that a head and its data are. Throws Error where they do not fit together; and Cancelled.
Volume metaimage_volume(const MetaImageHead& head, std::span<const char> data, const std::filesystem::path& path,
                        const Progress& progress = {});

/// Both, from a .mha, or from a .mhd and the file it names, which may be `outside` its folder or not.
Volume read_metaimage(const std::filesystem::path& path, bool outside, const Progress& progress = {});

}  // namespace chainmail

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "files/text/regular_file.h"

namespace chainmail {

/// The formats of pictures that open. No other format is tried: some name other files, which their readers open.
enum class PictureFormat { png, jpeg };

/// Number of bytes at the beginning of a file that decide about its format.
inline constexpr std::size_t picture_signature_size = 8;
/// Largest file of a picture (bytes). It is read as a whole.
inline constexpr std::uint64_t picture_file_limit = std::uint64_t{512} << 20;

/// Returns the format that the first bytes of a file state, if it is a picture.
std::optional<PictureFormat> picture_format(std::string_view beginning);

/// A picture without what its pixels do not need.
struct BarePicture {
  PictureFormat format = PictureFormat::png;
  std::string bytes;
  std::size_t scans = 1;  // of a JPEG: each one refines all pixels
};

/// Prepares the bytes of a file for a decoder, which sees only what decides about pixels: no text, which could unpack
/// to gigabytes, no colour profile and no preview. Of the camera's notes only the first block stays, which contains the
/// rotation. Throws Error about `path` if this is not a picture by its signature, or if its parts are not complete.
BarePicture bare_picture(std::string bytes, const std::filesystem::path& path);
/// Reads a file and prepares it. Also throws Error if it is larger than picture_file_limit.
BarePicture read_bare_picture(RegularFile file);

}  // namespace chainmail

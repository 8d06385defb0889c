#include "files/formats/bare_picture.h"

#include <algorithm>
#include <span>
#include <utility>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::string_view png_signature("\x89PNG\r\n\x1a\n", picture_signature_size);
constexpr std::string_view jpeg_signature = "\xff\xd8\xff";

[[noreturn]] void refuse_format(const std::filesystem::path& path) {
  throw Error(shown(path), "it is not a PNG or JPEG picture", "save it as one of these");
}

/// Moves the parts of a file that stay to its beginning, without a copy of the file.
class Sieve {
 public:
  explicit Sieve(std::string& bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  std::uint8_t byte(std::size_t i) const { return static_cast<std::uint8_t>(bytes_[at_ + i]); }
  std::string_view text(std::size_t from, std::size_t count) const {
    return std::string_view(bytes_).substr(at_ + from, count);
  }
  /// Returns a number whose highest byte comes first.
  std::size_t number(std::size_t from, std::size_t count) const {
    std::size_t value = 0;
    for (std::size_t i = from; i < from + count; ++i) {
      value = value << 8U | byte(i);
    }
    return value;
  }

  void keep(std::size_t count) {
    std::copy_n(bytes_.data() + at_, count, bytes_.data() + kept_);
    kept_ += count;
    at_ += count;
  }
  void drop(std::size_t count) { at_ += count; }
  void drop_rest() {
    bytes_.resize(kept_);
    at_ = kept_;
  }

 private:
  std::string& bytes_;
  std::size_t at_ = 0, kept_ = 0;
};

/// Keeps the chunks that a decoder must know, and transparency. Returns false if a chunk is not complete.
bool strip_png(std::string& bytes) {
  constexpr std::size_t frame = 12;              // length, type and checksum of a chunk
  constexpr std::uint8_t may_be_ignored = 0x20;  // a bit of the first letter of the type
  Sieve sieve(bytes);
  sieve.keep(picture_signature_size);
  while (sieve.left() >= frame) {
    const std::size_t length = sieve.number(0, 4);
    const std::string_view type = sieve.text(4, 4);
    if (length > sieve.left() - frame) {
      return false;
    }
    const bool ends = type == "IEND";
    if ((sieve.byte(4) & may_be_ignored) == 0 || type == "tRNS") {
      sieve.keep(length + frame);
    } else {
      sieve.drop(length + frame);
    }
    if (ends) {
      sieve.drop_rest();
      return true;
    }
  }
  return false;
}

/// The second bytes of the markers in a JPEG (ITU T.81, table B.1).
enum JpegMarker : std::uint8_t {
  stuffed_zero = 0x00,  // no marker, but data
  first_without_length = 0x01,
  first_restart = 0xD0,
  last_restart = 0xD7,
  end_of_image = 0xD9,
  start_of_scan = 0xDA,
  application_0 = 0xE0,
  application_1 = 0xE1,
  application_14 = 0xEE,
  application_15 = 0xEF,
  comment = 0xFE,
  fill = 0xFF
};

/// A JPEG, segment by segment.
class JpegSieve {
 public:
  explicit JpegSieve(std::string& bytes) : sieve_(bytes) { sieve_.keep(2); }

  /// Keeps what decides about pixels. Returns false if the picture has no end.
  bool strip() {
    while (find_marker()) {
      const std::uint8_t marker = sieve_.byte(1);
      if (marker == end_of_image) {
        sieve_.keep(2);
        sieve_.drop_rest();
        return true;
      }
      if (marker == first_without_length || (marker >= first_restart && marker <= last_restart)) {
        sieve_.drop(2);
      } else if (!take_segment(marker)) {
        return false;
      }
    }
    return false;
  }
  std::size_t scans() const { return scans_; }

 private:
  /// Moves to the next marker: some programs leave other bytes between segments, which decoders skip.
  bool find_marker() {
    while (sieve_.left() >= 2 && (sieve_.byte(0) != fill || sieve_.byte(1) == fill || sieve_.byte(1) == stuffed_zero)) {
      sieve_.drop(1);
    }
    return sieve_.left() >= 2;
  }
  bool take_segment(std::uint8_t marker) {
    const std::size_t length = sieve_.left() >= 4 ? sieve_.number(2, 2) : 0;
    if (length < 2 || length + 2 > sieve_.left()) {
      return false;
    }
    if (!is_needed(marker, length - 2)) {
      sieve_.drop(length + 2);
      return true;
    }
    sieve_.keep(length + 2);
    if (marker == start_of_scan) {
      ++scans_;
      take_scan();
    }
    return true;
  }
  /// The numbers of APP0 and APP14 say how colours are stored. Only the first notes of the camera stay: a decoder joins
  /// them.
  bool is_needed(std::uint8_t marker, std::size_t size) {
    if (marker == application_1) {
      constexpr std::string_view exif("Exif\0\0", 6);
      const bool first = !has_notes_ && size >= exif.size() && sieve_.text(4, exif.size()) == exif;
      has_notes_ = has_notes_ || first;
      return first;
    }
    const bool extra = (marker >= application_0 && marker <= application_15) || marker == comment;
    return !extra || marker == application_0 || marker == application_14;
  }
  /// Keeps the data of a scan: markers never appear in them, except for restarts.
  void take_scan() {
    for (;;) {
      sieve_.keep(std::min(sieve_.text(0, sieve_.left()).find(char(fill)), sieve_.left()));
      const std::uint8_t second = sieve_.left() >= 2 ? sieve_.byte(1) : std::uint8_t{end_of_image};
      if (second == fill) {
        sieve_.drop(1);
      } else if (second == stuffed_zero || (second >= first_restart && second <= last_restart)) {
        sieve_.keep(2);
      } else {
        return;
      }
    }
  }

  Sieve sieve_;
  std::size_t scans_ = 0;
  bool has_notes_ = false;
};

}  // namespace

std::optional<PictureFormat> picture_format(std::string_view beginning) {
  if (beginning.starts_with(png_signature)) {
    return PictureFormat::png;
  }
  return beginning.starts_with(jpeg_signature) ? std::optional(PictureFormat::jpeg) : std::nullopt;
}

BarePicture bare_picture(std::string bytes, const std::filesystem::path& path) {
  const auto format = picture_format(bytes);
  if (!format) {
    refuse_format(path);
  }
  BarePicture picture{*format, std::move(bytes)};
  bool is_complete = false;
  if (*format == PictureFormat::png) {
    is_complete = strip_png(picture.bytes);
  } else {
    JpegSieve sieve(picture.bytes);
    is_complete = sieve.strip();
    picture.scans = sieve.scans();
  }
  if (!is_complete) {
    throw Error(shown(path), "it is damaged", "open a complete PNG or JPEG file");
  }
  return picture;
}

BarePicture read_bare_picture(RegularFile file) {
  const std::filesystem::path path = file.path();
  std::string beginning(picture_signature_size, '\0');
  beginning.resize(file.read_at(0, beginning));
  if (!picture_format(beginning)) {
    refuse_format(path);  // before memory is taken for the whole
  }
  if (file.size() > picture_file_limit) {
    throw Error(shown(path), "it is larger than " + std::to_string(picture_file_limit >> 20) + " MiB",
                "scale the picture down first");
  }
  return bare_picture(read_bytes(std::move(file), "a picture"), path);
}

}  // namespace chainmail

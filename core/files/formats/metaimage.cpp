#include "files/formats/metaimage.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "files/formats/data_file.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::size_t longest_metaimage_head = 100'000;

class MetaImageHeadReader {
 public:
  MetaImageHeadReader(std::string_view text, const std::filesystem::path& path)
      : text_(text.substr(0, longest_metaimage_head)), path_(path) {}

  MetaImageHead read() {
    bool local = false;
    while (!local) {
      local = take_line() == "ElementDataFile";
    }
    check();
    return head_;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_, line_), problem, remedy);
  }

  /// Reads a line and returns its key.
  std::string_view take_line();
  void take(std::string_view key, std::string_view value);
  std::array<double, 3> numbers(std::string_view value) const;
  bool flag(std::string_view value) const;
  void check() const;

  std::string_view text_;
  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  std::uint32_t dimension_ = 0, channels_ = 1;
  bool binary_ = true, head_size_known_ = true;
  MetaImageHead head_;
};

std::string_view MetaImageHeadReader::take_line() {
  ++line_;
  const std::size_t end = text_.find('\n', head_.length);
  if (end == std::string_view::npos) {
    fail("the header ends before its line 'ElementDataFile = …'", "export the image again");
  }
  const std::string_view line = text_.substr(head_.length, end - head_.length);
  head_.length = end + 1;
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) {
    if (trimmed(line).empty()) {
      return {};
    }
    fail(in_quotes(trimmed(line)) + " is not a line of a header", "write 'Key = Value'");
  }
  const auto key = trimmed(line.substr(0, equals));
  take(key, trimmed(line.substr(equals + 1)));
  return key;
}

void MetaImageHeadReader::take(std::string_view key, std::string_view value) {
  if (key == "NDims") {
    dimension_ = parse_count(value).value_or(0);
  } else if (key == "DimSize") {
    const auto size = numbers(value);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(size[k] >= 0 && size[k] <= double(voxel_limit) && size[k] == std::floor(size[k]))) {
        fail("a size is not a whole number up to " + std::to_string(voxel_limit), "write three sizes");
      }
      head_.size[k] = static_cast<std::uint64_t>(size[k]);
    }
  } else if (key == "ElementSpacing" || (key == "ElementSize" && head_.spacing == Point::Ones())) {
    const auto spacing = numbers(value);
    head_.spacing = Point(spacing[0], spacing[1], spacing[2]).cwiseAbs();
  } else if (key == "Offset" || key == "Position" || key == "Origin") {
    const auto origin = numbers(value);
    head_.origin = Point(origin[0], origin[1], origin[2]);
  } else if (key == "ElementType") {
    head_.type = value;
  } else if (key == "ElementNumberOfChannels") {
    channels_ = parse_count(value).value_or(0);
  } else if (key == "BinaryDataByteOrderMSB" || key == "ElementByteOrderMSB") {
    head_.big_endian = flag(value);
  } else if (key == "BinaryData") {
    binary_ = flag(value);
  } else if (key == "CompressedData") {
    head_.compressed = flag(value);
  } else if (key == "HeaderSize") {
    head_size_known_ = value == "0";
  } else if (key == "ElementDataFile") {
    head_.data_file = value;
  }  // other keys, such as TransformMatrix and Comment, do not affect densities
}

std::array<double, 3> MetaImageHeadReader::numbers(std::string_view value) const {
  std::array<double, 3> numbers{};
  for (double& number : numbers) {
    const auto word = take_word(value);
    const auto parsed = parse_number(word);
    if (!parsed || std::abs(*parsed) > coordinate_limit) {
      fail(in_quotes(word) + " is not one of three finite numbers", "write one number for each axis of a volume");
    }
    number = *parsed;
  }
  return numbers;
}

bool MetaImageHeadReader::flag(std::string_view value) const {
  if (value != "True" && value != "False" && value != "true" && value != "false") {
    fail(in_quotes(value) + " is neither True nor False", "write one of them");
  }
  return value.front() == 'T' || value.front() == 't';
}

void MetaImageHeadReader::check() const {
  if (dimension_ != 3) {
    fail("the image does not have 3 dimensions", "use a volume");
  }
  if (channels_ != 1) {
    fail("the image has " + std::to_string(channels_) + " numbers per voxel",
         "use a volume with one density per voxel");
  }
  if (!binary_ || !head_size_known_) {
    fail("its data are text or have a header", "export it with binary data and HeaderSize 0");
  }
  if (!(head_.spacing.minCoeff() > 0)) {
    fail("the spacing of voxels is 0 along an axis", "use spacings above 0");
  }
  if (head_.data_file == "LIST" || head_.data_file.find('%') != std::string::npos) {
    fail("its data are in several files", "export it as one file");
  }
}

constexpr std::array metaimage_types{
    number_type<std::int8_t>("MET_CHAR"),
    number_type<std::uint8_t>("MET_UCHAR"),
    number_type<std::int16_t>("MET_SHORT"),
    number_type<std::uint16_t>("MET_USHORT"),
    number_type<std::int32_t>("MET_INT"),
    number_type<std::uint32_t>("MET_UINT"),
    number_type<std::int32_t>("MET_LONG"),
    number_type<std::uint32_t>("MET_ULONG"),
    number_type<std::int64_t>("MET_LONG_LONG"),
    number_type<std::uint64_t>("MET_ULONG_LONG"),
    number_type<float>("MET_FLOAT"),
    number_type<double>("MET_DOUBLE"),
};

const NumberType& metaimage_type(const MetaImageHead& head, const std::filesystem::path& path) {
  const NumberType* found = find_number_type(metaimage_types, head.type);
  if (found == nullptr) {
    throw Error(shown(path), "numbers of type " + in_quotes(head.type) + " are not known",
                "export it as MET_UCHAR, MET_SHORT or MET_FLOAT");
  }
  return *found;
}

/// Numbers compressed by zlib (Gailly and Adler). Each reading decompresses them again in pieces, because the data of a
/// small file may exceed the memory.
class PackedNumbers {
 public:
  PackedNumbers(std::span<const char> data, const NumberType& type, bool big_endian, const std::filesystem::path& path)
      : data_(data), type_(type), big_endian_(big_endian), path_(path), piece_(piece_numbers * type.bytes) {
    if (inflateInit2(&stream_, 15 + 32) != Z_OK) {  // accepts both formats of zlib
      throw std::bad_alloc();
    }
  }
  PackedNumbers(const PackedNumbers&) = delete;
  PackedNumbers& operator=(const PackedNumbers&) = delete;
  ~PackedNumbers() { inflateEnd(&stream_); }

  /// Returns number i of `count`. i is 0, or one more than in the last call.
  double operator()(std::size_t i, std::size_t count) {
    if (i == 0) {
      restart();
    }
    const std::size_t at = i % piece_numbers;
    if (at == 0) {
      unpack(std::min(piece_numbers, count - i) * type_.bytes);
    }
    return type_.read(piece_.data() + at * type_.bytes, big_endian_);
  }

 private:
  void restart() {
    inflateReset(&stream_);
    stream_.avail_in = 0;
    taken_ = 0;
  }
  void unpack(std::size_t bytes) {
    stream_.next_out = reinterpret_cast<Bytef*>(piece_.data());
    stream_.avail_out = static_cast<uInt>(bytes);
    while (stream_.avail_out > 0) {
      if (stream_.avail_in == 0) {
        const std::size_t in = std::min(data_.size() - taken_, most_in);
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data_.data() + taken_));  // zlib only reads it
        stream_.avail_in = static_cast<uInt>(in);
        taken_ += in;
      }
      const int state = inflate(&stream_, Z_NO_FLUSH);
      if (stream_.avail_out > 0 && (state != Z_OK || (stream_.avail_in == 0 && taken_ == data_.size()))) {
        throw Error(shown(path_), "its compressed data are damaged or incomplete", "export it again");
      }
    }
  }

  static constexpr std::size_t piece_numbers = std::size_t{1} << 16;
  static constexpr std::size_t most_in = std::size_t{1} << 20;

  std::span<const char> data_;
  const NumberType& type_;
  bool big_endian_;
  const std::filesystem::path& path_;
  std::vector<char> piece_;
  z_stream stream_{};
  std::size_t taken_ = 0;
};

/// Reports the progress of two readings of the same numbers.
class TwicePassed {
 public:
  TwicePassed(std::size_t count, const Progress& progress) : count_(2 * count), progress_(progress) {}
  void count() { progress_.report(done_++, count_); }

 private:
  std::size_t done_ = 0, count_;
  const Progress& progress_;
};

}  // namespace

MetaImageHead read_metaimage_head(std::string_view text, const std::filesystem::path& path) {
  return MetaImageHeadReader(text, path).read();
}

Volume metaimage_volume(const MetaImageHead& head, std::span<const char> data, const std::filesystem::path& path,
                        const Progress& progress) {
  const NumberType& type = metaimage_type(head, path);
  Volume volume;
  volume.size = checked_volume_size(shown(path), head.size);
  volume.spacing = head.spacing;
  volume.origin = head.origin;
  const std::size_t count = volume.voxel_count();
  TwicePassed passed(count, progress);
  if (head.compressed) {
    PackedNumbers number(data, type, head.big_endian, path);
    take_densities(volume, shown(path), [&](std::size_t i) {
      passed.count();
      return number(i, count);
    });
    return volume;
  }
  if (data.size() < count * type.bytes) {
    throw Error(
        shown(path),
        "its data end after " + std::to_string(data.size()) + " of " + std::to_string(count * type.bytes) + " bytes",
        "export it again");
  }
  take_densities(volume, shown(path), [&](std::size_t i) {
    passed.count();
    return type.read(data.data() + i * type.bytes, head.big_endian);
  });
  return volume;
}

Volume read_metaimage(const std::filesystem::path& path, bool outside, const Progress& progress) {
  const std::string file = read_bytes(path, "a volume", progress.part(0, 0.2));
  const MetaImageHead head = read_metaimage_head(file, path);
  if (head.data_file == "LOCAL") {
    return metaimage_volume(head, std::span(file).subspan(head.length), path, progress.part(0.2, 1));
  }
  const auto data = data_file(path, head.data_file, outside);
  const std::string bytes = read_bytes(data, "voxels", progress.part(0, 0.2));
  return metaimage_volume(head, bytes, data, progress.part(0.2, 1));
}

}  // namespace chainmail

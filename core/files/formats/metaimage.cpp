#include "files/formats/metaimage.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <vector>

#include "files/formats/data_file.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

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

const NumberType& type_of(const MetaImageHead& head, const std::filesystem::path& path) {
  const NumberType* found = find_number_type(metaimage_types, head.type);
  if (found == nullptr) {
    throw Error(shown(path), "numbers of type " + in_quotes(head.type) + " are not known",
                "export it as MET_UCHAR, MET_SHORT or MET_FLOAT");
  }
  return *found;
}

/// The numbers that zlib (Gailly and Adler) has packed, one after another. They are unpacked in pieces, anew each time
/// the first one is asked for: what a small file unpacks to may be larger than the memory.
class PackedNumbers {
 public:
  PackedNumbers(std::span<const char> data, const NumberType& type, bool big_endian, const std::filesystem::path& path)
      : data_(data), type_(type), big_endian_(big_endian), path_(path), piece_(piece_numbers * type.bytes) {
    if (inflateInit2(&stream_, 15 + 32) != Z_OK) {  // either of its two formats
      throw std::bad_alloc();
    }
  }
  PackedNumbers(const PackedNumbers&) = delete;
  PackedNumbers& operator=(const PackedNumbers&) = delete;
  ~PackedNumbers() { inflateEnd(&stream_); }

  /// The i-th of `count`; i is 0, or one more than the last time.
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
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data_.data() + taken_));  // it is only read
        stream_.avail_in = static_cast<uInt>(in);
        taken_ += in;
      }
      const int state = inflate(&stream_, Z_NO_FLUSH);
      if (stream_.avail_out > 0 && (state != Z_OK || (stream_.avail_in == 0 && taken_ == data_.size()))) {
        throw Error(shown(path_), "its packed data are damaged, or fewer than its size says", "export it anew");
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

/// Says how much is done of numbers that are gone through twice.
class TwicePassed {
 public:
  TwicePassed(std::size_t count, const Progress& progress) : count_(2 * count), progress_(progress) {}
  void count() { progress_.report(done_++, count_); }

 private:
  std::size_t done_ = 0, count_;
  const Progress& progress_;
};

}  // namespace

Volume metaimage_volume(const MetaImageHead& head, std::span<const char> data, const std::filesystem::path& path,
                        const Progress& progress) {
  const NumberType& type = type_of(head, path);
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
        "export it anew");
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

#include "files/formats/metaimage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "files/formats/data_file.h"
#include "files/text/limits.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

#ifdef CHAINMAIL_HAS_ZLIB
#include <zlib.h>
#endif

namespace chainmail {
namespace {

class MetaImageHeadReader {
 public:
  MetaImageHeadReader(std::string_view text, const std::filesystem::path& path)
      : text_(text.substr(0, limits::metaimage_header_bytes)), path_(path) {}

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
  std::array<double, 3> numbers(std::string_view& value) const;
  void take_dimension(std::string_view value);
  void take_size(std::string_view value);
  void take_axes(std::string_view value);
  void take_files(std::string_view value);
  bool flag(std::string_view value) const;
  void check() const;

  std::string_view text_;
  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  std::uint32_t dimension_ = 0, channels_ = 1;
  bool binary_ = true;
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

/// Four dimensions are a volume if there is one of them in time.
void MetaImageHeadReader::take_dimension(std::string_view value) {
  dimension_ = parse_count(value).value_or(0);
  if (dimension_ != 3 && dimension_ != 4) {
    fail("it is an image of " + printable(value) + " dimensions", "use a volume, which has 3");
  }
}

void MetaImageHeadReader::take_size(std::string_view value) {
  const auto size = numbers(value);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(size[k] >= 0 && size[k] <= double(limits::voxels) && size[k] == std::floor(size[k]))) {
      fail("a size is not a whole number up to " + std::to_string(limits::voxels), "write three sizes");
    }
    head_.size[k] = static_cast<std::uint64_t>(size[k]);
  }
  if (const auto frames = take_word(value); dimension_ == 4 && frames != "1") {
    fail("it has " + in_quotes(frames) + " volumes, one for each time", "save one of them");
  }
}

/// The matrix has the direction of each axis of the voxels, one after another.
void MetaImageHeadReader::take_axes(std::string_view value) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto direction = numbers(value);
    head_.axes.col(k) = Point(direction[0], direction[1], direction[2]).stableNormalized();
    if (dimension_ == 4) {
      take_word(value);
    }
  }
  if (!are_axes(head_.axes)) {
    fail("the directions of its axes lie in one plane", "write three directions in space");
  }
}

void MetaImageHeadReader::take(std::string_view key, std::string_view value) {
  if (key == "NDims") {
    take_dimension(value);
  } else if (key == "DimSize") {
    take_size(value);
  } else if (key == "TransformMatrix" || key == "Rotation" || key == "Orientation") {
    take_axes(value);
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
    head_.at_end = value == "-1";
    const auto skipped = head_.at_end ? std::optional(0U) : parse_count(value);
    if (!skipped) {
      fail(in_quotes(value) + " is not a number of bytes", "write HeaderSize = 0");
    }
    head_.skipped = *skipped;
  } else if (key == "ElementDataFile") {
    take_files(value);
  }  // other keys, such as Comment and Modality, do not affect the object
}

/// The number behind LIST is that of the dimensions of each file; those of a pattern have a layer each.
void MetaImageHeadReader::take_files(std::string_view value) {
  DataNames data = data_names(value, text_.substr(head_.length), head_.size[2], limits::metaimage_files);
  const std::uint32_t dimension = value.starts_with("LIST") ? parse_count(data.dimension).value_or(dimension_ - 1) : 2;
  std::uint64_t files = 1;
  for (std::size_t k = dimension; data.are_parts && k < 3 && files <= limits::metaimage_files; ++k) {
    files *= head_.size[k];
  }
  if (data.names.size() != files || files > limits::metaimage_files) {
    fail("it names " + std::to_string(data.names.size()) + " data files for " + std::to_string(files) +
             " parts of its volume, of at most " + std::to_string(limits::metaimage_files),
         "export it as one file");
  }
  if (value != "LOCAL") {
    head_.data_files = std::move(data.names);
  }
}

/// Takes three numbers off a value.
std::array<double, 3> MetaImageHeadReader::numbers(std::string_view& value) const {
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
  const bool is_true = is_word(value, "true") || value == "1";
  if (!is_true && !is_word(value, "false") && value != "0") {
    fail(in_quotes(value) + " is neither True nor False", "write one of them");
  }
  return is_true;
}

void MetaImageHeadReader::check() const {
  if (dimension_ == 0) {
    fail("the number of dimensions is missing", "write NDims = 3");
  }
  if (channels_ != 1) {
    fail("the image has " + std::to_string(channels_) + " numbers per voxel",
         "use a volume with one density per voxel");
  }
  if (!binary_ || (head_.compressed && (head_.at_end || head_.data_files.size() > 1))) {
    fail("its data are text, or compressed in several files or behind a header",
         "export it with binary data, as one file");
  }
  if (!(head_.spacing.minCoeff() > 0)) {
    fail("the spacing of voxels is 0 along an axis", "use spacings above 0");
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

/// The data of a volume: a part of a file, or of memory.
struct VoxelData {
  std::uint64_t size = 0;
  /// Reads bytes from a place in the data. Returns fewer only at their end.
  std::function<std::size_t(std::uint64_t place, std::span<char> to)> read;
  const std::filesystem::path& path;
};

/// The numbers of a volume as bytes, in their order.
class VoxelBytes {
 public:
  VoxelBytes() = default;
  VoxelBytes(const VoxelBytes&) = delete;
  VoxelBytes& operator=(const VoxelBytes&) = delete;
  virtual ~VoxelBytes() = default;

  virtual void restart() = 0;
  /// Reads the next bytes. Throws Error if there are fewer.
  virtual void take(std::span<char> to) = 0;
};

class PlainBytes : public VoxelBytes {
 public:
  explicit PlainBytes(const VoxelData& data) : data_(data) {}

  void restart() override { taken_ = 0; }
  void take(std::span<char> to) override {
    if (data_.read(taken_, to) < to.size()) {
      throw Error(shown(data_.path), "it became shorter while it was read", "open it again when it is complete");
    }
    taken_ += to.size();
  }

 private:
  const VoxelData& data_;
  std::uint64_t taken_ = 0;
};

#ifdef CHAINMAIL_HAS_ZLIB
/// Bytes compressed by zlib (Gailly and Adler). Each reading decompresses them again in pieces, because the data of a
/// small file may exceed the memory.
class PackedBytes : public VoxelBytes {
 public:
  explicit PackedBytes(const VoxelData& data) : data_(data), in_(max_in) {
    if (inflateInit2(&stream_, 15 + 32) != Z_OK) {  // accepts both formats of zlib
      throw std::bad_alloc();
    }
  }
  PackedBytes(const PackedBytes&) = delete;
  PackedBytes& operator=(const PackedBytes&) = delete;
  ~PackedBytes() override { inflateEnd(&stream_); }

  void restart() override {
    inflateReset(&stream_);
    stream_.avail_in = 0;
    taken_ = 0;
  }
  void take(std::span<char> to) override {
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(to.size());
    while (stream_.avail_out > 0) {
      if (stream_.avail_in == 0) {
        const std::size_t in = data_.read(taken_, in_);
        stream_.next_in = reinterpret_cast<Bytef*>(in_.data());
        stream_.avail_in = static_cast<uInt>(in);
        taken_ += in;
      }
      const int state = inflate(&stream_, Z_NO_FLUSH);
      if (stream_.avail_out > 0 && (state != Z_OK || (stream_.avail_in == 0 && taken_ == data_.size))) {
        throw Error(shown(data_.path), "its compressed data are damaged or incomplete", "export it again");
      }
    }
  }

 private:
  static constexpr std::size_t max_in = std::size_t{1} << 20;

  const VoxelData& data_;
  std::vector<char> in_;
  z_stream stream_{};
  std::uint64_t taken_ = 0;
};
#endif

/// Throws Error if the data cannot contain this many bytes, before they are read.
void check_size(const VoxelData& data, bool compressed, std::uint64_t bytes) {
  if (compressed && bytes / limits::compression_ratio > data.size) {
    throw Error(shown(data.path),
                "its " + std::to_string(data.size) + " bytes of compressed data are too few for its voxels",
                "export it again");
  }
  if (!compressed && data.size < bytes) {
    throw Error(shown(data.path),
                "its data end after " + std::to_string(data.size) + " of " + std::to_string(bytes) + " bytes",
                "export it again");
  }
}

std::unique_ptr<VoxelBytes> bytes_of(const VoxelData& data, bool compressed) {
  if (compressed) {
#ifdef CHAINMAIL_HAS_ZLIB
    return std::make_unique<PackedBytes>(data);
#else
    throw Error(shown(data.path), "its data are compressed, and this program was built without zlib",
                "save it uncompressed, or build the program with zlib");
#endif
  }
  return std::make_unique<PlainBytes>(data);
}

Volume volume_of(const MetaImageHead& head, const VoxelData& data, const Progress& progress) {
  constexpr std::size_t in_piece = std::size_t{1} << 16;
  const NumberType& type = metaimage_type(head, data.path);
  Volume volume;
  volume.size = checked_volume_size(shown(data.path), head.size);
  volume.spacing = head.spacing;
  volume.origin = head.origin;
  volume.axes = head.axes;
  const std::size_t count = volume.voxel_count();
  check_size(data, head.compressed, count * type.bytes);
  const auto bytes = bytes_of(data, head.compressed);
  std::vector<char> piece(std::min(in_piece, count) * type.bytes);
  std::vector<double> numbers(std::min(in_piece, count));
  std::size_t done = 0;
  take_densities(volume, shown(data.path), [&](std::size_t i) {
    if (i == 0) {
      bytes->restart();
    }
    if (i % in_piece == 0) {
      const std::size_t next = std::min(in_piece, count - i);
      bytes->take(std::span(piece).first(next * type.bytes));
      type.read(piece.data(), head.big_endian, std::span(numbers).first(next));
      progress.report(double(done) / double(2 * count));  // of two readings
      done += next;
    }
    return numbers[i % in_piece];
  });
  return volume;
}

/// Returns the size of the data (bytes).
std::uint64_t data_size(const MetaImageHead& head, const std::filesystem::path& path) {
  const auto size = checked_volume_size(shown(path), head.size);
  return std::uint64_t{size[0]} * size[1] * size[2] * metaimage_type(head, path).bytes;
}

/// The data of a volume in files of their own, with the same number of bytes each. One of them is open at a time.
class DataFiles {
 public:
  DataFiles(const MetaImageHead& head, const std::filesystem::path& path, bool outside) : head_(head) {
    for (const std::string& name : head.data_files) {
      paths_.push_back(data_file(path, name, outside));
    }
    open(0);
    const std::uint64_t present = file_->size() - std::min(head.skipped, file_->size());
    bytes_ = head.compressed ? present : data_size(head, path) / paths_.size();
    size_ = paths_.size() == 1 ? std::min(bytes_, present) : paths_.size() * bytes_;
  }

  VoxelData data() {
    return {size_, [this](std::uint64_t place, std::span<char> to) { return read(place, to); }, paths_.front()};
  }

 private:
  void open(std::size_t part) {
    if (!file_ || part != open_) {
      file_.emplace(paths_[open_ = part]);
    }
  }
  std::size_t read(std::uint64_t place, std::span<char> to) {
    std::size_t done = 0;
    while (done < to.size() && place + done < size_) {
      const std::uint64_t in_part = (place + done) % bytes_, next = std::min(to.size() - done, bytes_ - in_part);
      open((place + done) / bytes_);
      const std::uint64_t begin = head_.at_end ? file_->size() - std::min(bytes_, file_->size()) : head_.skipped;
      if (file_->read_at(begin + in_part, to.subspan(done, next)) < next) {
        throw Error(shown(file_->path()), "it ends before the " + std::to_string(bytes_) + " bytes of its part",
                    "export the volume again");
      }
      done += next;
    }
    return done;
  }

  const MetaImageHead& head_;
  std::vector<std::filesystem::path> paths_;
  std::optional<RegularFile> file_;
  std::size_t open_ = 0;
  std::uint64_t bytes_ = 0, size_ = 0;  // of each, and of all
};

VoxelData data_in(const RegularFile& file, std::uint64_t from, const std::filesystem::path& path) {
  return {file.size() - from, [&file, from](std::uint64_t at, auto to) { return file.read_at(from + at, to); }, path};
}

}  // namespace

MetaImageHead read_metaimage_head(std::string_view text, const std::filesystem::path& path) {
  return MetaImageHeadReader(text, path).read();
}

Volume metaimage_volume(const MetaImageHead& head, std::span<const char> data, const std::filesystem::path& path,
                        const Progress& progress) {
  const auto read = [data](std::uint64_t at, std::span<char> to) {
    const auto rest = data.subspan(std::min(std::size_t(at), data.size()));
    const auto part = rest.first(std::min(rest.size(), to.size()));
    std::copy(part.begin(), part.end(), to.begin());
    return part.size();
  };
  return volume_of(head, {data.size(), read, path}, progress);
}

Volume read_metaimage(RegularFile file, bool outside, const Progress& progress) {
  const std::filesystem::path& path = file.path();
  std::string beginning(std::min<std::uint64_t>(limits::metaimage_header_bytes, file.size()), '\0');
  beginning.resize(file.read(beginning));
  const MetaImageHead head = read_metaimage_head(beginning, path);
  if (head.data_files.empty()) {
    const std::uint64_t begin = head.skipped > 0 ? std::min(head.skipped, file.size()) : head.length;
    return volume_of(head, data_in(file, begin, path), progress);
  }
  DataFiles files(head, path, outside);
  return volume_of(head, files.data(), progress);
}

}  // namespace chainmail

#include "files/metaimage.h"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "files/data_file.h"
#include "files/number_type.h"
#include "files/text.h"
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

/// What zlib (Gailly and Adler) has packed; no more than it should be is taken.
std::vector<char> unpacked(std::span<const char> data, std::size_t size, const std::filesystem::path& path,
                           const Progress& progress) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 32) != Z_OK) {  // either of its two formats
    throw std::bad_alloc();
  }
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  static constexpr std::size_t piece = std::size_t{1} << 20;
  std::vector<char> result;
  int state = Z_OK;
  for (std::size_t taken = 0; state == Z_OK && result.size() < size;) {
    progress.report(double(result.size()) / double(size));
    const std::size_t before = result.size();
    result.resize(std::min(size, before + piece));
    const std::size_t in = std::min(data.size() - taken, piece);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data() + taken));  // it is only read
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(result.data() + before);
    stream.avail_out = static_cast<uInt>(result.size() - before);
    state = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    result.resize(result.size() - stream.avail_out);
    if (state == Z_OK && in == 0 && result.size() == before) {
      break;
    }
  }
  if (result.size() != size) {
    throw Error(shown(path), "its packed data are damaged, or fewer than its size says", "export it anew");
  }
  return result;
}

}  // namespace

Volume metaimage_volume(const MetaImageHead& head, std::span<const char> data, const std::filesystem::path& path,
                        const Progress& progress) {
  const NumberType& type = type_of(head, path);
  Volume volume;
  volume.size = checked_volume_size(shown(path), head.size);
  volume.spacing = head.spacing;
  volume.origin = head.origin;
  const std::size_t size = volume.voxel_count() * type.bytes;
  std::vector<char> plain;
  if (head.compressed) {
    plain = unpacked(data, size, path, progress.part(0, 0.5));
    data = plain;
  }
  if (data.size() < size) {
    throw Error(shown(path),
                "its data end after " + std::to_string(data.size()) + " of " + std::to_string(size) + " bytes",
                "export it anew");
  }
  take_densities(volume, shown(path), [&](std::size_t i) {
    progress.part(0.5, 1).report(i, volume.voxel_count());
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

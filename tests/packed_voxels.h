#pragma once

#include <zlib.h>

#include <QByteArray>
#include <array>

namespace chainmail::test {

/// Returns megabytes of voxels of one byte, half of each with density 0 and half with 255, in about 1 KB per megabyte
/// as zlib compresses them (RFC 1950). They are compressed once and repeated; the checksum at the end is missing.
inline QByteArray packed_voxels(int megabytes) {
  constexpr qsizetype megabyte = 1 << 20;
  QByteArray voxels(megabyte / 2, '\0');
  voxels += QByteArray(megabyte / 2, '\xff');
  std::array<char, 1 << 16> packed{};
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY);  // without header and checksum
  stream.next_in = reinterpret_cast<Bytef*>(voxels.data());
  stream.avail_in = uInt(voxels.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  deflate(&stream, Z_FULL_FLUSH);  // what follows does not refer to it
  deflateEnd(&stream);
  return "\x78\x9c" + QByteArray(packed.data(), qsizetype(packed.size() - stream.avail_out)).repeated(megabytes);
}

/// Returns a MetaImage file of this size with packed_voxels().
inline QByteArray packed_volume(std::array<int, 3> size) {
  const auto [x, y, z] = size;
  const QByteArray sizes = QByteArray::number(x) + ' ' + QByteArray::number(y) + ' ' + QByteArray::number(z);
  const int megabytes = int((qint64(x) * y * z) >> 20);
  return "ObjectType = Image\nNDims = 3\nDimSize = " + sizes +
         "\nElementType = MET_UCHAR\nCompressedData = True\nElementDataFile = LOCAL\n" + packed_voxels(megabytes);
}

}  // namespace chainmail::test

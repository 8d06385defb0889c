#include "io/picture_file.h"

#include <QBuffer>
#include <QImageReader>
#include <utility>

#include "files/formats/bare_picture.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/sheet.h"
#include "mesh/texture.h"

namespace chainmail {
namespace {

// Larger pictures are refused before memory is taken: a pixel takes up to 12 bytes while the picture is decoded, even
// if the file is small.
constexpr double pictureLimit = 100e6;
// Largest number of pixels of a JPEG times its scans. A usual progressive JPEG has about 10.
constexpr double scannedPixelLimit = 12 * pictureLimit;
constexpr int megabyte = 1 << 20;

[[noreturn]] void failPicture(const std::filesystem::path& path, const QString& problem, const char* remedy) {
  throw Error(shown(path), problem.toStdString(), remedy);
}

/// A picture in memory, with Qt's reader for its format. Qt tries no other format: some open other files.
class PictureReader {
 public:
  explicit PictureReader(RegularFile file) : path_(file.path()), picture_(read_bare_picture(std::move(file))) {
    QImageReader::setAllocationLimit(int(4 * pictureLimit / megabyte) +
                                     1);  // in MB, a limit for all readers; pictures here are smaller
    bytes_.setData(QByteArray::fromRawData(picture_.bytes.data(), qsizetype(picture_.bytes.size())));
    bytes_.open(QIODevice::ReadOnly);
    reader_.setAutoDetectImageFormat(false);
    reader_.setAutoTransform(true);
    reader_.setDevice(&bytes_);
    reader_.setFormat(picture_.format == PictureFormat::png ? "png" : "jpeg");
    if (!reader_.canRead() || size().isEmpty()) {
      failPicture(path_, QStringLiteral("its header is damaged"), "open a complete PNG or JPEG file");
    }
    checkSize();
  }

  /// Returns the size in pixels, with the rotation that the camera stored.
  QSize size() const {
    const QSize stored = reader_.size();
    const bool turned = (reader_.transformation() & QImageIOHandler::TransformationRotate90) != 0;
    return turned ? stored.transposed() : stored;
  }
  QImage read() {
    const QSize stated = size();
    QImage image;
    if (!reader_.read(&image) || image.size() != stated) {
      failPicture(path_, QStringLiteral("it is damaged"), "open a complete PNG or JPEG file");
    }
    return image;
  }

 private:
  void checkSize() const {
    constexpr int usualBits = 32;  // of a pixel in memory
    const bool large = QImage::toPixelFormat(reader_.imageFormat()).bitsPerPixel() > usualBits;
    const double pixels = double(size().width()) * size().height(), limit = large ? pictureLimit / 2 : pictureLimit;
    if (pixels > limit) {
      failPicture(path_,
                  QStringLiteral("it has %L1 × %L2 pixels%4, more than %L3 million")
                      .arg(size().width())
                      .arg(size().height())
                      .arg(qRound(limit / 1e6))
                      .arg(large ? QStringLiteral(" of 16 bits per colour") : QString()),
                  "scale the picture down first");
    }
    if (pixels * double(picture_.scans) > scannedPixelLimit) {
      failPicture(path_, QStringLiteral("it stores its pixels in %L1 scans").arg(picture_.scans),
                  "save it again, in another program");
    }
  }

  std::filesystem::path path_;
  BarePicture picture_;
  QBuffer bytes_;  // of picture_
  QImageReader reader_;
};

/// Returns a picture with four channels, the bottom row first. It has no box: make_sheet() sets one.
Texture readPicture(RegularFile file, const Progress& progress) {
  QImage image = PictureReader(std::move(file)).read();
  progress.report(0.5);
  image.convertTo(QImage::Format_RGBA8888);
  progress.report(0.8);
  Texture picture;
  picture.size = {std::uint32_t(image.width()), std::uint32_t(image.height()), 1};
  picture.texels.reserve(picture.byte_count());
  for (int y = image.height(); y-- > 0;) {
    const uchar* row = image.constScanLine(y);
    picture.texels.insert(picture.texels.end(), row, row + qsizetype(4) * image.width());
  }
  progress.report(1);
  return picture;
}

}  // namespace

MeshPointer readSheet(RegularFile file, std::uint32_t across, const Progress& progress) {
  return make_sheet(readPicture(std::move(file), progress.part(0, 0.7)), across, progress.part(0.7, 1));
}

}  // namespace chainmail

#include "io/picture_file.h"

#include <QFile>
#include <QFileInfo>
#include <QImageReader>
#include <QImageWriter>
#include <QPainter>
#include <QSaveFile>

#include "common/as_path.h"
#include "files/mesh/warp.h"
#include "files/text/regular_file.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr qsizetype headerBytes = 8;
constexpr int jpegQuality = 95;
constexpr int megabyte = 1 << 20;

bool endsAsPicture(const QString& path) {
  const QString ending = QFileInfo(path).suffix().toLower();
  return ending == QLatin1String("png") || ending == QLatin1String("jpg") || ending == QLatin1String("jpeg");
}

[[noreturn]] void failPicture(const QString& path, const QString& problem, const char* remedy) {
  throw Error(path.toStdString(), problem.toStdString(), remedy);
}

/// Sets up a reader that decides the format by content, not by name.
void setUp(QImageReader& reader, const QString& path) {
  require_file(asPath(path));
  QImageReader::setAllocationLimit(int(4 * picture_limit / megabyte) +
                                   1);  // in MB, a limit for all readers; pictures here are smaller
  reader.setDecideFormatFromContent(true);
  reader.setAutoTransform(true);
  reader.setFileName(path);
  if (QFile file(path); !file.open(QIODevice::ReadOnly)) {
    failPicture(path, QStringLiteral("it cannot be read (%1)").arg(file.errorString()),
                "check its name and permissions");
  }
  if (!reader.canRead()) {
    failPicture(path, QStringLiteral("it is not a picture"), "open a PNG or JPEG file");
  }
}

QSize sizeOf(const QImageReader& reader) {
  const QSize size = reader.size();
  return (reader.transformation() & QImageIOHandler::TransformationRotate90) != 0 ? size.transposed() : size;
}

/// True for a truncated JPEG: the end marker is missing after the last scan. Qt decodes it and fills the rest with
/// grey. The two markers never appear within a scan.
bool endsEarly(const QString& path) {
  QFile file(path);
  const qint64 size = file.open(QIODevice::ReadOnly) ? file.size() : 0;
  const uchar* bytes = size > 0 ? file.map(0, size) : nullptr;
  if (bytes == nullptr || size < 2 || bytes[0] != 0xFF || bytes[1] != 0xD8) {
    return false;
  }
  for (qint64 i = size - 2; i > 0; --i) {
    if (bytes[i] == 0xFF && (bytes[i + 1] == 0xD9 || bytes[i + 1] == 0xDA)) {
      return bytes[i + 1] == 0xDA;
    }
  }
  return true;
}

QImage asImage(const Texture& picture) {
  const QImage upward(picture.texels.data(), int(picture.size[0]), int(picture.size[1]), qsizetype(4) * picture.size[0],
                      QImage::Format_RGBA8888);
  return upward.mirrored();
}

/// Returns the image on a white background, without transparency.
QImage opaque(const QImage& image) {
  QImage result(image.size(), QImage::Format_RGB888);
  result.fill(Qt::white);
  QPainter(&result).drawImage(0, 0, image);
  return result;
}

}  // namespace

bool isPicture(const QString& path) {
  if (endsAsPicture(path)) {
    return true;
  }
  QFile file(path);  // opening a pipe could block the window
  const bool opened = QFileInfo(path).isFile() && file.open(QIODevice::ReadOnly);
  const QByteArray header = opened ? file.read(headerBytes) : QByteArray();
  return header == QByteArray("\x89PNG\r\n\x1a\n", headerBytes) || header.startsWith("\xff\xd8\xff");
}

QSize pictureSize(const QString& path) {
  QImageReader reader;
  setUp(reader, path);
  const QSize size = sizeOf(reader);
  if (size.isEmpty()) {
    failPicture(path, QStringLiteral("its header is damaged"), "open a complete PNG or JPEG file");
  }
  if (double(size.width()) * size.height() > picture_limit) {
    failPicture(path,
                QStringLiteral("it has %L1 × %L2 pixels, more than %L3 million")
                    .arg(size.width())
                    .arg(size.height())
                    .arg(qRound(picture_limit / 1e6)),
                "scale the picture down first");
  }
  return size;
}

Texture readPictureFile(const QString& path, const Progress& progress) {
  const QSize size = pictureSize(path);
  QImageReader reader;
  setUp(reader, path);
  QImage image;
  if (endsEarly(path) || !reader.read(&image) || image.size() != size) {
    failPicture(path, QStringLiteral("it is damaged"), "open a complete PNG or JPEG file");
  }
  progress.report(0.5);
  image.convertTo(QImage::Format_RGBA8888);
  progress.report(0.8);
  Texture picture;
  picture.size = {std::uint32_t(size.width()), std::uint32_t(size.height()), 1};
  picture.texels.reserve(picture.byte_count());
  for (int y = size.height(); y-- > 0;) {
    const uchar* row = image.constScanLine(y);
    picture.texels.insert(picture.texels.end(), row, row + qsizetype(4) * size.width());
  }
  picture.box = {Point::Zero(), Point(size.width(), size.height(), 0)};
  progress.report(1);
  return picture;
}

void writePictureFile(const QString& path, const Texture& picture, const Progress& progress) {
  const bool jpeg = !path.endsWith(QStringLiteral(".png"), Qt::CaseInsensitive);
  if (jpeg && !endsAsPicture(path)) {
    failPicture(path, QStringLiteral("its ending is unknown"), "use .png or .jpg");
  }
  const QImage image = asImage(picture);
  QSaveFile file(path);
  QImageWriter writer(&file, jpeg ? "jpeg" : "png");
  if (jpeg) {
    writer.setQuality(jpegQuality);
  }
  progress.report(0.2);
  if (!file.open(QIODevice::WriteOnly) || !writer.write(jpeg ? opaque(image) : image)) {
    const QString why = file.error() != QFileDevice::NoError ? file.errorString() : writer.errorString();
    failPicture(path, QStringLiteral("the picture could not be written (%1)").arg(why),
                "choose another folder, or PNG");
  }
  progress.report(1);
  if (!file.commit()) {
    failPicture(path, QStringLiteral("the picture could not be written (%1)").arg(file.errorString()),
                "choose another folder");
  }
}

}  // namespace chainmail

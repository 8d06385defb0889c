// Makes the thumbnails of the samples for the target `thumbnails`.

#include <QImage>
#include <QPainter>

#include "common/as_path.h"
#include "files/mesh/input_file.h"
#include "io/file_actions.h"
#include "io/samples.h"
#include "window.h"

using namespace chainmail;

namespace {

constexpr QSize thumbnail{104, 78};  // device pixels, two per logical pixel
constexpr QSize drawn{200, 150};     // small enough that links of one pixel are still visible in the thumbnail

QImage pictureOf(const QString& path) {
  if (open_file(asPath(path)).kind == FileKind::picture) {
    return QImage(path);
  }
  Workbench bench;
  bench.window.findChild<FileActions*>()->openSample(path);
  bench.settle();
  if (const Mesh& mesh = *bench.document().mesh(); mesh.texture || !mesh.tetrahedra.empty()) {
    bench.trigger("section");  // shows that the object is solid
  }
  View& view = bench.view(0);
  view.setFixedSize(drawn);
  bench.settle();
  view.fitRest();
  return view.picture(1, true);
}

/// Returns the part of a picture that contains something.
QRect drawnPart(const QImage& picture) {
  QRect part;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (picture.pixelColor(x, y).alpha() != 0) {
        part |= QRect(x, y, 1, 1);
      }
    }
  }
  return part;
}

/// Returns the drawn part, scaled to the size of a thumbnail and centred.
QImage framed(const QImage& picture) {
  QImage result(thumbnail, QImage::Format_ARGB32_Premultiplied);
  result.fill(Qt::transparent);
  const QImage scaled =
      picture.copy(drawnPart(picture)).scaled(thumbnail, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  QPainter(&result).drawImage((thumbnail.width() - scaled.width()) / 2, (thumbnail.height() - scaled.height()) / 2,
                              scaled);
  return result;
}

bool saveAll(const QString& folder, colours::Ground ground) {
  remember(ground);
  applyGround(ground);
  for (const Sample& sample : samples()) {
    const QString path = samplesFolder() + QLatin1Char('/') + QString::fromUtf8(sample.file);
    const QString to = folder + QLatin1Char('/') + thumbnailOf(sample, ground);
    if (!framed(pictureOf(path)).save(to)) {
      qCritical("%s cannot be written", qPrintable(to));
      return false;
    }
  }
  return true;
}

}  // namespace

/// Takes the path of the resources folder.
int main(int argc, char** argv) {
  prepareApplication();
  const QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  QApplication application(argc, argv);
  styleApplication();
  const QString folder = QString::fromLocal8Bit(argv[1]);
  return saveAll(folder, colours::Ground::dark) && saveAll(folder, colours::Ground::light) ? 0 : 1;
}

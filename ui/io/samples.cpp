#include "io/samples.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <array>

namespace chainmail {
namespace {

constexpr std::array table{
    Sample{"line.dat", "Line", "A chain", 40},
    Sample{"3x3.dat", "3 × 3", "The example of Dean's thesis (2004), in its format", 9},
    Sample{"grid.dat", "Grid", "A flat grid, links along the axes", 576},
    Sample{"cloth.obj", "Cloth", "A flat sheet of triangles", 384},
    Sample{"sphere.obj", "Sphere", "A closed surface of triangles", 266},
    Sample{"torus.obj", "Torus", "A closed surface of quadrangles", 384},
    Sample{"organ.obj", "Organ", "A closed surface, shaped like a kidney", 1212},
    Sample{"organ.msh", "Full organ", "The organ filled with tetrahedra: cut it open", 2240},
    Sample{"jittered.vtk", "Jittered", "A block of irregular tetrahedra", 792},
    Sample{"phantom.nrrd", "Volume", "A volume of densities: a soft body with a hard core", 8120},
    Sample{"scan.mha", "Scan", "The volume with slices two units apart, as from a scanner", 2624},
    Sample{"inclusion.chainmail", "Inclusion", "A session: a soft sheet with a rigid disc in it", 768},
    Sample{"face.png", "Picture", "A picture on a sheet that you can warp", 768},
};

constexpr std::array lessonTable{
    LessonFile{"order.chainmail", "Why order matters"},
    LessonFile{"waiting-list.chainmail", "The waiting list, step by step"},
    LessonFile{"exact.chainmail", "Exact and taut"},
    LessonFile{"organ.chainmail", "Cut an organ"},
    LessonFile{"physics.chainmail", "ChainMail against FEM"},
};

/// Returns a folder beside the programs, in the build as after an installation; an empty string without this file in
/// it.
QString folderWith(const char* file, const QString& folder) {
  const QString path = QDir::cleanPath(QCoreApplication::applicationDirPath() + QLatin1Char('/') + folder);
  return QFileInfo::exists(QDir(path).filePath(QLatin1String(file))) ? path : QString();
}

bool isIn(const QString& folder, const QString& path) {
  return !folder.isEmpty() && QFileInfo(path).canonicalPath() == QFileInfo(folder).canonicalFilePath();
}

}  // namespace

std::span<const Sample> samples() { return table; }

QString samplesFolder() { return folderWith(table.front().file, QStringLiteral(DATA_FOLDER "/meshes")); }

std::span<const LessonFile> lessonFiles() { return lessonTable; }

QString lessonsFolder() { return folderWith(lessonTable.front().file, QStringLiteral(DATA_FOLDER "/lessons")); }

bool isSample(const QString& path) { return isIn(samplesFolder(), path) || isIn(lessonsFolder(), path); }

QString thumbnailOf(const Sample& sample, colours::Ground ground) {
  const QString folder = ground == colours::Ground::light ? QStringLiteral("samples/light") : QStringLiteral("samples");
  return QStringLiteral("%1/%2.png").arg(folder, QString::fromUtf8(sample.file));
}

}  // namespace chainmail

#include "io/mesh_source.h"

#include <QDir>
#include <QFileInfo>

#include "common/as_path.h"
#include "files/mesh/open_mesh.h"
#include "files/text/text.h"
#include "io/picture_file.h"
#include "io/samples.h"
#include "mesh/error.h"
#include "mesh/sheet.h"

namespace chainmail {
namespace {

QString found(const QString& session, const QString& name) {
  for (const QString& folder : {QFileInfo(session).path(), samplesFolder()}) {
    QString path = QDir(folder).filePath(name);
    if (std::error_code none; !folder.isEmpty() && std::filesystem::exists(asPath(path), none)) {
      return path;
    }
  }
  throw Error(shown(asPath(session)), "its mesh " + in_quotes(name.toStdString()) + " was not found",
              "put that file into the folder of the session");
}

}  // namespace

MeshOpener meshesNear(const QString& session) {
  return [session](const std::string& name, std::uint32_t across, const Progress& progress) -> MeshPointer {
    const QString path = found(session, QString::fromStdString(name));
    if (!isPicture(path)) {
      return open_mesh(asPath(path), {}, progress).mesh;
    }
    return make_sheet(readPictureFile(path, progress.part(0, 0.7)), across > 0 ? across : elementsAcross,
                      progress.part(0.7, 1));
  };
}

}  // namespace chainmail

// Events that build, open and save.

#include <QDropEvent>
#include <QFile>
#include <QMimeData>
#include <QSpinBox>

#include "docks/replay_dock.h"
#include "io/file_actions.h"
#include "io/picture_actions.h"
#include "io/sessions.h"
#include "monkey.h"

namespace chainmail {

void Monkey::build() {
  auto* kind = bench_.find<QComboBox>("meshKind");
  const int which = int(below(std::size_t(kind->count())));
  say(QStringLiteral("build %1").arg(kind->itemText(which)));
  kind->setCurrentIndex(which);
  for (const char* size : {"sizeW", "sizeH", "sizeD"}) {
    bench_.find<QSpinBox>(size)->setValue(2 + int(below(8)));
  }
  click("buildMesh");
}

/// Returns a path. The file may not exist yet, or its content may not fit its name.
QString Monkey::anyPath() {
  static constexpr std::array names{"any.obj",     "any.dat",      "any.chainmail",     "other.chainmail",
                                    "garbage.obj", "garbage.dat",  "garbage.chainmail", "moves.json",
                                    "any.obj",     "any.chainmail"};
  return folder_ + QLatin1Char('/') + QLatin1String(names[below(names.size())]);
}

void Monkey::drop(const QString& path) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(path)});
  QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&bench_.window, &enter);
  if (enter.isAccepted()) {
    QDropEvent dropped(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&bench_.window, &dropped);
  }
}

void Monkey::openSomething() {
  writeGarbage();
  const QString path = once(8) ? folder_ : anyPath();
  const std::size_t how = below(4);
  if (how == 0) {
    say(QStringLiteral("drop %1").arg(path));
    drop(path);
  } else if (how == 1) {
    say(QStringLiteral("open moves %1").arg(path));
    bench_.window.findChild<ReplayDock*>()->openMoves(path);
  } else {
    say(QStringLiteral("open %1").arg(path));
    bench_.window.openFile(path);
  }
}

void Monkey::saveSomething() {
  const QString path = anyPath();
  auto& files = *bench_.window.findChild<FileActions*>();
  auto& replay = *bench_.window.findChild<ReplayDock*>();
  const QString drawing = once(2) ? QStringLiteral("png") : once(2) ? QStringLiteral("svg") : QStringLiteral("pdf");
  const std::size_t what = below(6);
  say(QStringLiteral("save %1: %2").arg(what).arg(path));
  switch (what) {
    case 0:
      return files.savePath(path);
    case 1:
      return files.saveShapePath(int(below(Document::maxPanels)), path);
    case 2:
      return bench_.window.findChild<PictureActions*>()->savePath(folder_ + QStringLiteral("/picture.") + drawing);
    case 3:
      return replay.saveMoves(folder_ + QStringLiteral("/moves.json"));
    default:
      return bench_.window.sessions().savePath(path);
  }
}

/// Writes a valid file with errors in it, or noise.
void Monkey::writeGarbage() {
  static constexpr std::array ends{"obj", "dat", "chainmail"};
  const QString end = QLatin1String(ends[below(ends.size())]);
  QFile good(folder_ + QStringLiteral("/any.") + end);
  QByteArray bytes = good.open(QIODevice::ReadOnly) ? good.readAll() : QByteArray("v 0 0 0\nl 1 2\n{\"mesh\":3}");
  for (std::size_t i = below(20); i > 0 && !bytes.isEmpty(); --i) {
    bytes[qsizetype(below(std::size_t(bytes.size())))] = char(below(256));
  }
  bytes.truncate(qsizetype(below(std::size_t(bytes.size()) + 1)));
  QFile garbage(folder_ + QStringLiteral("/garbage.") + end);
  if (garbage.open(QIODevice::WriteOnly)) {
    garbage.write(bytes);
  }
}

}  // namespace chainmail

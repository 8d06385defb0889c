#include "io/unsaved_work.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QLockFile>
#include <QStandardPaths>
#include <QUuid>

#include "common/as_path.h"

namespace chainmail::unsaved_work {
namespace {

constexpr QLatin1String closedEnding(".closed.chainmail"), lockEnding(".lock"), objectEnding(".object-");
constexpr int mostClosed = 5;

QString ending() { return QString::fromUtf8(session_ending.data(), qsizetype(session_ending.size())); }

/// Returns the folder and the part of the name that all files of the same work have.
QString stem(const QString& path) {
  const QFileInfo file(path);
  return QDir(file.path()).filePath(file.fileName().section(QLatin1Char('.'), 0, 0));
}

QFileInfoList filesLike(const QString& pattern, QDir::Filters filters = QDir::Files) {
  return QDir(folder()).entryInfoList({pattern}, filters, QDir::Time);
}

/// Removes unfinished files. A running program finishes a file within seconds.
void discardUnfinished() {
  const QDateTime old = QDateTime::currentDateTime().addSecs(-600);
  for (const QFileInfo& file : filesLike(QStringLiteral("*.tmp"), QDir::Files | QDir::Hidden)) {
    if (file.lastModified() < old) {
      QFile::remove(file.filePath());
    }
  }
}

/// Removes the lock and the objects of work that does not exist, unless a running program is about to write it.
void discardWithoutWork(const QString& path) {
  if (QFile::exists(path) || QFile::exists(closedPath(path))) {
    return;
  }
  QLockFile lock(lockOf(path));
  lock.setStaleLockTime(0);
  if (lock.tryLock()) {
    discardObjects(path);
  }
}

}  // namespace

QString folder() {
  QString path = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + QStringLiteral("/autosave");
  QDir().mkpath(path);
  return path;
}

QString newPath() { return QDir(folder()).filePath(QUuid::createUuid().toString(QUuid::Id128).left(12) + ending()); }

QString closedPath(const QString& path) { return stem(path) + closedEnding; }

bool isClosed(const QString& path) { return path.endsWith(closedEnding); }

QString lockOf(const QString& path) { return path + lockEnding; }

QString objectName(const QString& path, int number) {
  return QFileInfo(stem(path)).fileName() + objectEnding + QString::number(number);
}

Session read(const QString& path, const Progress& progress) {
  return read_session(asPath(path), progress, [](const std::string& name, std::uint32_t, const Progress& part) {
    return read_session(asPath(QDir(folder()).filePath(QString::fromStdString(name))), part).mesh;
  });
}

void discardObjects(const QString& path, const QString& kept) {
  for (const QFileInfo& file : filesLike(QFileInfo(stem(path)).fileName() + objectEnding + QLatin1Char('*'))) {
    if (file.fileName() != kept) {
      QFile::remove(file.filePath());
    }
  }
}

void discard(const QString& path) {
  QFile::remove(path);
  discardObjects(path);
}

void discardOldest() {
  for (const QFileInfo& file : filesLike(QLatin1Char('*') + closedEnding).mid(mostClosed)) {
    discard(file.filePath());
  }
}

void discardLeftovers() {
  discardUnfinished();
  for (const QFileInfo& file : filesLike(QLatin1Char('*') + ending() + lockEnding)) {
    const QString path = file.filePath().chopped(lockEnding.size());
    QLockFile lock(file.filePath());
    lock.setStaleLockTime(0);
    if (!QFile::exists(path)) {
      lock.tryLock();  // the destructor of the lock removes it, unless a running program holds it
    }
  }
  for (const QFileInfo& file : filesLike(QLatin1Char('*') + objectEnding + QLatin1Char('*'))) {
    discardWithoutWork(stem(file.filePath()) + ending());
  }
}

}  // namespace chainmail::unsaved_work

#include "io/unsaved_work.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QUuid>
#include <algorithm>

#include "common/as_path.h"

namespace chainmail::unsaved_work {
namespace {

constexpr QLatin1String closedMark(".closed"), lockEnding(".lock"), objectEnding(".object-");

QString ending() { return QString::fromUtf8(session_ending.data(), qsizetype(session_ending.size())); }

/// Returns the folder and the part of the name that all files of the same work have.
QString stem(const QString& path) {
  const QFileInfo file(path);
  return QDir(file.path()).filePath(file.fileName().section(QLatin1Char('.'), 0, 0));
}

QFileInfoList filesLike(const QString& pattern, QDir::Filters filters = QDir::Files) {
  return QDir(folder()).entryInfoList({pattern}, filters, QDir::Name);
}

/// Returns the number that orders work: M of closed work, else N. Names without one come first.
qulonglong orderOf(const QString& path) {
  static const QRegularExpression number(QStringLiteral(R"(^(?:[^.]*\.closed-(\d{1,18})\.|(\d{1,18})-))"));
  const auto match = number.match(QFileInfo(path).fileName());
  return match.captured(match.captured(1).isEmpty() ? 2 : 1).toULongLong();
}

/// Returns a number above those of all work.
qulonglong nextNumber() {
  qulonglong highest = 0;
  for (const QFileInfo& file : filesLike(QLatin1Char('*') + ending() + QLatin1Char('*'))) {
    highest = std::max(highest, orderOf(file.fileName()));
  }
  return highest + 1;
}

/// Returns true if there is work that belongs to a lock or an object with this stem.
bool hasWork(const QString& path) {
  return !filesLike(QFileInfo(stem(path)).fileName() + QStringLiteral(".*") + ending()).isEmpty() ||
         QFile::exists(stem(path) + ending());
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
  if (hasWork(path)) {
    return;
  }
  if (const auto own = lock(path)) {
    discardObjects(path);
  }
}

}  // namespace

QString folder() {
  QString path = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + QStringLiteral("/autosave");
  QDir().mkpath(path);
  QFile::setPermissions(path, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  return path;
}

QString newPath() {
  const QString id = QUuid::createUuid().toString(QUuid::Id128).left(12);
  return QDir(folder()).filePath(QStringLiteral("%1-%2").arg(nextNumber()).arg(id) + ending());
}

QString closedPath(const QString& path) {
  return stem(path) + closedMark + QLatin1Char('-') + QString::number(nextNumber()) + ending();
}

bool isClosed(const QString& path) { return QFileInfo(path).fileName().contains(closedMark); }

std::unique_ptr<QLockFile> lock(const QString& path) {
  auto lock = std::make_unique<QLockFile>(path + lockEnding);
  lock->setStaleLockTime(0);
  return lock->tryLock() ? std::move(lock) : nullptr;
}

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

QStringList all() {
  // The number of a crash is that of its start, which says nothing about when it happened.
  const auto age = [](const QString& path) {
    return std::pair(isClosed(path) ? 0 : QFileInfo(path).lastModified().toMSecsSinceEpoch(), orderOf(path));
  };
  QStringList paths;
  for (const QFileInfo& file : filesLike(QLatin1Char('*') + ending())) {
    paths << file.filePath();
  }
  std::ranges::sort(paths, {}, age);
  return paths;
}

void discardOldest() {
  QStringList closed = all();
  closed.removeIf([](const QString& path) { return !isClosed(path); });
  for (const QString& path : closed.first(std::max<qsizetype>(0, closed.size() - maxClosed))) {
    if (const auto own = lock(path)) {
      discard(path);
    }
  }
}

void discardLeftovers() {
  discardUnfinished();
  for (const QFileInfo& file : filesLike(QLatin1Char('*') + ending() + lockEnding)) {
    const QString path = file.filePath().chopped(lockEnding.size());
    if (!QFile::exists(path)) {
      lock(path);  // its destructor removes it, unless a running program holds it
    }
  }
  for (const QFileInfo& file : filesLike(QLatin1Char('*') + objectEnding + QLatin1Char('*'))) {
    discardWithoutWork(stem(file.filePath()) + ending());
  }
}

}  // namespace chainmail::unsaved_work

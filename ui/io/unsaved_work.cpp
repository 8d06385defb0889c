#include "io/unsaved_work.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLocale>
#include <QPushButton>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QUuid>
#include <algorithm>

#include "common/as_path.h"
#include "common/colours.h"
#include "files/mesh/input_file.h"

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

namespace chainmail {
namespace {

QPushButton* makeButton(const QString& text, const char* name, const QString& help) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setToolTip(help);
  return button;
}

}  // namespace

RecoveryBar::RecoveryBar() : text_(new QLabel) {
  setObjectName(QStringLiteral("recoveryBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  text_->setObjectName(QStringLiteral("recovery"));
  text_->setWordWrap(true);
  auto* restore = makeButton(QStringLiteral("&Restore"), "restoreWork",
                             QStringLiteral("Restores object, cuts, pins, softness and positions as one undo step"));
  auto* discard = makeButton(QStringLiteral("Dis&card"), "discardWork",
                             QStringLiteral("Deletes the unsaved work when this window closes; the open object stays"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->addWidget(text_, 1);
  row->addWidget(restore);
  row->addWidget(discard);
  connect(restore, &QPushButton::clicked, this, [this] { emit restoreRequested(found_.back().path); });
  connect(discard, &QPushButton::clicked, this, [this] {
    moveLast(found_, discarded_);
    show();
    emit discarded();
  });
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::infoGround);
    setPalette(own);
  });
}

void RecoveryBar::offer() {
  unsaved_work::discardLeftovers();
  for (const QString& path : unsaved_work::all()) {
    if (auto lock = unsaved_work::lock(path)) {
      found_.push_back({path, std::move(lock)});
    }
  }
  show();
}

void RecoveryBar::takeBack() {
  while (!discarded_.empty()) {
    moveLast(discarded_, found_);
  }
  show();
}

void RecoveryBar::moveLast(std::vector<Found>& from, std::vector<Found>& to) {
  to.push_back(std::move(from.back()));
  from.pop_back();
}

void RecoveryBar::show() {
  emit changed();
  setVisible(!found_.empty());
  if (found_.empty()) {
    return;
  }
  const QString time = QLocale().toString(QFileInfo(found_.back().path).lastModified(), QLocale::ShortFormat);
  const QString others = found_.size() > 1 ? QStringLiteral(" (1 of %1)").arg(found_.size()) : QString();
  const bool closed = unsaved_work::isClosed(found_.back().path);
  text_->setText((closed ? QStringLiteral("Unsaved work from %1: the window was closed without saving%2")
                         : QStringLiteral("Unsaved work from %1: the workbench ended without saving%2"))
                     .arg(time, others));
}

void RecoveryBar::release() {
  for (const Found& work : discarded_) {
    unsaved_work::discard(work.path);
  }
  discarded_.clear();
  found_.clear();
  show();
}

std::unique_ptr<QLockFile> RecoveryBar::take(const QString& path) {
  std::unique_ptr<QLockFile> lock;
  for (auto* works : {&found_, &discarded_}) {
    if (const auto at = std::ranges::find(*works, path, &Found::path); at != works->end()) {
      lock = std::move(at->lock);
      works->erase(at);
    }
  }
  show();
  return lock;
}

}  // namespace chainmail

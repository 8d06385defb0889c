#include "io/session_watch.h"

#include <sys/stat.h>

#include <QFile>
#include <QFileInfo>

#include "common/as_path.h"

namespace chainmail {
namespace {

constexpr int calmMilliseconds = 300;

}  // namespace

std::optional<FileState> stateOf(const QString& path) {
  struct stat status {};
  if (stat(asPath(path).c_str(), &status) != 0) {
    return std::nullopt;
  }
  return FileState{std::uint64_t(status.st_dev), std::uint64_t(status.st_ino), std::uint64_t(status.st_size),
                   std::int64_t(status.st_mtim.tv_sec), std::int64_t(status.st_mtim.tv_nsec)};
}

SessionWatch::SessionWatch(Document& document, QObject* parent) : QObject(parent), document_(document) {
  calm_.setSingleShot(true);
  calm_.setInterval(calmMilliseconds);
  connect(&calm_, &QTimer::timeout, this, &SessionWatch::look);
  connect(&watcher_, &QFileSystemWatcher::fileChanged, this, [this] { calm_.start(); });
  connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, [this] { calm_.start(); });
  connect(&document_.files(), &DocumentFiles::sessionChanged, this, &SessionWatch::follow);
  connect(&document_.files(), &DocumentFiles::meshChanged, this, &SessionWatch::follow);
  connect(&document_, &Document::meshChanged, this, [this] {
    if (followed_ != this->path()) {
      follow();
    }
  });
}

void SessionWatch::know(const QString& path, const std::optional<FileState>& state) {
  if (state) {
    known_[path] = *state;
  } else {
    known_.erase(path);
  }
}

bool SessionWatch::isChanged(const QString& path) const {
  const auto known = known_.find(path);
  const auto now = stateOf(path);
  return known != known_.end() && now && *now != known->second;
}

/// Returns the watched file; empty if there is none.
const QString& SessionWatch::path() const {
  return document_.files().session().isEmpty() ? document_.files().mesh() : document_.files().session();
}

/// Watches the file, and its folder, because most programs replace a file.
void SessionWatch::follow() {
  told_.reset();
  emit followed();
  if (const QStringList watched = watcher_.files() + watcher_.directories(); !watched.isEmpty()) {
    watcher_.removePaths(watched);
  }
  followed_ = path();
  if (const QString& path = followed_; !path.isEmpty()) {
    watcher_.addPaths({path, QFileInfo(path).absolutePath()});
    calm_.start();  // it may have changed while it was not watched
  }
}

void SessionWatch::look() {
  const QString& path = this->path();
  if (path.isEmpty()) {
    return;
  }
  if (!watcher_.files().contains(path) && QFile::exists(path)) {
    watcher_.addPath(path);  // it was replaced
  }
  const auto now = stateOf(path);
  if (isChanged(path) && told_ != now) {
    told_ = now;
    emit changedOutside(path);
  }
}

}  // namespace chainmail

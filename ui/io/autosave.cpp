#include "io/autosave.h"

#include <QDir>
#include <QFile>
#include <QStandardPaths>
#include <QUuid>
#include <algorithm>
#include <atomic>

#include "common/as_path.h"
#include "document/session_draft.h"
#include "files/session/session.h"
#include "mesh/progress.h"

namespace chainmail {
namespace {

using std::chrono::milliseconds;

// Longest time from a change to the written file: the wait and, at worst, two writes.
constexpr milliseconds mostBehind(4500), shortestWait(500), longestWait(4000);

constexpr QLatin1String closedEnding(".closed.chainmail");
constexpr int mostClosed = 5;  // files of closed windows; older ones are removed

/// Removes the oldest files of closed windows.
void dropOldest() {
  const auto closed =
      QDir(Autosave::folder()).entryInfoList({QLatin1Char('*') + closedEnding}, QDir::Files, QDir::Time);
  for (const QFileInfo& file : closed.mid(mostClosed)) {
    QFile::remove(file.filePath());
  }
}

QString newPath() {
  return QDir(Autosave::folder())
      .filePath(QUuid::createUuid().toString(QUuid::Id128).left(12) + QStringLiteral(".chainmail"));
}

}  // namespace

QString Autosave::folder() {
  QString path = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + QStringLiteral("/autosave");
  QDir().mkpath(path);
  return path;
}

struct Autosave::Writing {
  JobState job;
  // The thread writes it before it sets `done`; the window reads it after that.
  std::string error;
  std::atomic<bool> done = false;
};

Autosave::Autosave(Document& document, LookAccess look, QObject* parent)
    : QObject(parent),
      document_(document),
      look_(std::move(look)),
      path_(newPath()),
      lock_(lockOf(path_)),
      timer_(this) {
  lock_.setStaleLockTime(0);  // valid as long as the program runs
  lock_.tryLock();
  timer_.setObjectName(QStringLiteral("autosaveTimer"));
  timer_.setSingleShot(true);
  timer_.setInterval(longestWait);
  connect(&timer_, &QTimer::timeout, this, &Autosave::save);
  listen();
}

bool Autosave::isClosed(const QString& path) { return path.endsWith(closedEnding); }

Autosave::~Autosave() {
  endWriting();
  remove();
}

void Autosave::endWriting() {
  if (writing_) {
    writing_->job.cancelled = true;
  }
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Autosave::keep() {
  closed_ = true;
  timer_.stop();
  if (!document_.isModified()) {
    return;
  }
  endWriting();
  thread_ = std::jthread([path = path_, draft = SessionDraft(document_, look_.read())] {
    try {
      save_session(asPath(path), draft.finished({}), {});
    } catch (const std::exception&) {
      // The window is gone, so nothing can be reported. The previous file stays.
    }
    if (QFile::exists(path)) {
      QFile::rename(path, path.chopped(qsizetype(session_ending.size())) + closedEnding);
      dropOldest();
    }
  });
}

bool Autosave::setAside() {
  if (closed_ || !document_.isModified()) {
    return false;
  }
  const QString path = newPath().chopped(qsizetype(session_ending.size())) + closedEnding;
  aside_ = std::jthread([path, draft = SessionDraft(document_, look_.read())] {
    try {
      save_session(asPath(path), draft.finished({}), {});
      dropOldest();
    } catch (const std::exception&) {
      // The work can still be undone; automatic saving reports a full disk.
    }
  });
  return true;
}

void Autosave::listen() {
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, [this] {
    ++steps_;
    noticeChange();
  });
  connect(&document_.undoStack(), &QUndoStack::cleanChanged, this, &Autosave::noticeChange);
  connect(&document_, &Document::frameReady, this, &Autosave::noticeChange);
  look_.follow(*this, [this] { noticeChange(); });
}

/// Runs for every frame, so it must be cheap.
void Autosave::noticeChange() {
  if (closed_) {
    return;
  }
  changed_ = true;
  if (!writing_ && !timer_.isActive() && !broken_) {
    timer_.start();
  }
}

Autosave::Mark Autosave::mark() const {
  Mark mark{steps_, {}, look_.read()};
  for (int panel = 0; panel < document_.panels(); ++panel) {
    const Frame* frame = document_.frame(panel);
    mark.changed.push_back(frame == nullptr || frame->changed.empty() ? 0 : *std::ranges::max_element(frame->changed));
  }
  return mark;
}

void Autosave::save() {
  if (!document_.isModified()) {
    remove();
    return;
  }
  Mark now = mark();
  if (now == saved_) {
    return;  // the frame or the look changed back
  }
  saved_ = std::move(now);
  changed_ = false;
  begun_ = std::chrono::steady_clock::now();
  writing_ = std::make_shared<Writing>();
  thread_ = std::jthread([this, writing = writing_, path = path_, draft = SessionDraft(document_, saved_.look)] {
    try {
      const Progress progress(writing->job);
      save_session(asPath(path), draft.finished(progress), progress);
    } catch (const std::exception& problem) {
      writing->error = problem.what();
    }
    writing->done = true;
    QMetaObject::invokeMethod(this, &Autosave::receive, Qt::QueuedConnection);
  });
}

void Autosave::receive() {
  if (closed_) {
    return;
  }
  const auto written = std::exchange(writing_, nullptr);
  if (!written->error.empty()) {
    broken_ = true;
    emit failed(QStringLiteral("Automatic saving has stopped: %1").arg(QString::fromStdString(written->error)));
    return;
  }
  const auto took = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begun_);
  timer_.setInterval(std::clamp(mostBehind - 2 * took, shortestWait, longestWait));
  if (changed_) {
    timer_.start();
  }
}

void Autosave::adopt(const QString& path) {
  if (QFile::exists(path_)) {
    QFile::remove(path);
  } else {
    QFile::rename(path, path_);
  }
}

void Autosave::remove() {
  QFile::remove(path_);
  saved_ = {};
}

}  // namespace chainmail

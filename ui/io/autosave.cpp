#include "io/autosave.h"

#include <QDir>
#include <QFile>
#include <algorithm>
#include <atomic>

#include "common/as_path.h"
#include "document/session_draft.h"
#include "files/session/session.h"
#include "io/unsaved_work.h"
#include "mesh/progress.h"

namespace chainmail {
namespace {

using std::chrono::milliseconds;

// Longest time from a change to the written file: the wait and, at worst, two writes.
constexpr milliseconds mostBehind(4500), shortestWait(500), longestWait(4000);

}  // namespace

struct Autosave::Writing {
  JobState job;
  // The thread writes them before it sets `done`; the window reads them after that.
  Object object;
  std::string error;
  std::atomic<bool> done = false;
};

Autosave::Autosave(Document& document, LookAccess look, QObject* parent)
    : QObject(parent),
      document_(document),
      look_(std::move(look)),
      path_(unsaved_work::newPath()),
      lock_(unsaved_work::lockOf(path_)),
      timer_(this) {
  lock_.setStaleLockTime(0);  // valid as long as the program runs
  lock_.tryLock();
  timer_.setObjectName(QStringLiteral("autosaveTimer"));
  timer_.setSingleShot(true);
  timer_.setInterval(longestWait);
  connect(&timer_, &QTimer::timeout, this, &Autosave::save);
  listen();
}

Autosave::~Autosave() {
  endWriting();
  remove();
}

void Autosave::discardAll(std::vector<Adopted>& adopted) {
  for (const Adopted& work : adopted) {
    unsaved_work::discard(work.path);
  }
  adopted.clear();
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
  thread_ = std::jthread(
      [path = path_, adopted = std::move(adopted_), draft = SessionDraft(document_, look_.read())]() mutable {
        try {
          save_session(asPath(path), draft.finished({}), {});
          unsaved_work::discardObjects(path);
          discardAll(adopted);
        } catch (const std::exception&) {
          // The window is gone, so nothing can be reported. The previous files stay.
        }
        if (QFile::exists(path)) {
          QFile::rename(path, unsaved_work::closedPath(path));
          unsaved_work::discardOldest();
        }
      });
}

bool Autosave::setAside() {
  if (closed_ || !document_.isModified()) {
    return false;
  }
  const QString path = unsaved_work::closedPath(unsaved_work::newPath());
  aside_ = std::jthread([path, draft = SessionDraft(document_, look_.read())] {
    try {
      save_session(asPath(path), draft.finished({}), {});
      unsaved_work::discardOldest();
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

/// Writes the object into a file of its own, unless that file has it already.
Autosave::Object Autosave::withObject(const QString& path, const Session& session, Object object,
                                      const Progress& progress) {
  const MeshPointer mesh = written_mesh(session);
  if (object.mesh.lock() != mesh) {
    object = {mesh, object.number + 1};
    Session alone;
    alone.name = session.name;
    alone.mesh = mesh;
    alone.panels.emplace_back();
    save_session(asPath(QDir(unsaved_work::folder()).filePath(unsaved_work::objectName(path, object.number))), alone,
                 progress);
  }
  return object;
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
  thread_ = std::jthread(
      [this, writing = writing_, path = path_, object = object_, draft = SessionDraft(document_, saved_.look)] {
        try {
          const Progress progress(writing->job);
          Session session = draft.finished(progress);
          writing->object = withObject(path, session, object, progress.part(0, 0.5));
          const QString name = unsaved_work::objectName(path, writing->object.number);
          session.mesh_file = name.toStdString();
          save_session(asPath(path), session, progress.part(0.5, 1));
          unsaved_work::discardObjects(path, name);
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
  object_ = written->object;
  discardAll(adopted_);
  const auto took = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begun_);
  timer_.setInterval(std::clamp(mostBehind - 2 * took, shortestWait, longestWait));
  if (changed_) {
    timer_.start();
  }
}

void Autosave::adopt(const QString& path, std::unique_ptr<QLockFile> lock) {
  adopted_.push_back({path, std::move(lock)});
}

void Autosave::remove() {
  unsaved_work::discard(path_);
  saved_ = {};
  object_ = {};
  discardAll(adopted_);
}

}  // namespace chainmail

#include "io/autosave.h"

#include <QDir>
#include <QFile>
#include <algorithm>
#include <atomic>
#include <future>
#include <utility>

#include "common/as_path.h"
#include "common/jobs.h"
#include "document/session_draft.h"
#include "files/session/session.h"
#include "io/unsaved_work.h"
#include "mesh/error.h"
#include "mesh/progress.h"

namespace chainmail {
namespace {

using std::chrono::milliseconds;

// Longest time from a change to the written file: the wait and, at worst, two writes.
constexpr milliseconds maxBehind(4500), shortestWait(500), longestWait(4000);
constexpr milliseconds shortestRetry(10'000), longestRetry(300'000);

/// Returns a sentence about the exception that is being handled.
QString failure() { return QString::fromStdString(failure_sentence("unsaved work")); }

}  // namespace

struct Autosave::Writing {
  Progress job = Progress::watched();
  QString path;
  // The thread writes them before it sets `done`; the window reads them after that.
  Object object;  // in its file, before and after
  QString error;
  bool isWritten = false;
  std::atomic<bool> done = false;
};

Autosave::Autosave(Document& document, LayoutAccess layout, QObject* parent)
    : QObject(parent), document_(document), layout_(std::move(layout)), timer_(this) {
  timer_.setObjectName(QStringLiteral("autosaveTimer"));
  timer_.setSingleShot(true);
  timer_.setInterval(longestWait);
  connect(&timer_, &QTimer::timeout, this, &Autosave::save);
  begin();
  listen();
}

/// Begins to save to new files.
void Autosave::begin() {
  path_ = unsaved_work::newPath();
  lock_ = unsaved_work::lock(path_);
  saved_ = {};
  object_ = {};
}

Autosave::~Autosave() {
  cancelWriting();
  thread_.finish();
  if (!keeps_) {
    remove();
  }
}

void Autosave::adopt(const QString& path, std::unique_ptr<QLockFile> lock, const MeshPointer& mesh) {
  adopted_.push_back({path, std::move(lock), mesh});
}

void Autosave::discardAdopted(const MeshPointer& mesh) {
  std::erase_if(adopted_, [&](const Adopted& work) {
    const bool isSaved = work.mesh.lock() == mesh;
    if (isSaved) {
      unsaved_work::discard(work.path);
    }
    return isSaved;
  });
}

void Autosave::cancelWriting() {
  if (writing_) {
    writing_->job.cancel();
  }
}

QString Autosave::keep() {
  const bool isKept = std::exchange(closed_, true);
  timer_.stop();
  if (isKept || !document_.isModified()) {
    return {};
  }
  QString why = handOver();
  keeps_ = why.isEmpty();
  if (!keeps_) {  // the window may stay open
    closed_ = false;
    timer_.start();
  }
  return why;
}

QString Autosave::setAside() {
  if (closed_ || !document_.isModified()) {
    return {};
  }
  QString why = handOver();
  if (why.isEmpty()) {
    begin();
  }
  return why;
}

/// Writes the work, and leaves its files to the next start. Returns why it could not be written, or an empty text.
QString Autosave::handOver() {
  QString why = writeNow();
  if (why.isEmpty()) {
    discardAdopted(document_.unsplitMesh());
    const QString closed = unsaved_work::closedPath(path_);
    QFile::rename(path_, closed);
    adopt(closed, unsaved_work::lock(closed), document_.unsplitMesh());
  }
  return why;
}

/// Waits until the files have the work as it is now.
QString Autosave::writeNow() {
  const Mark now = mark();
  if (!writing_ && now == saved_ && document_.solvers().settled() && QFile::exists(path_)) {
    return {};
  }
  cancelWriting();
  try {
    startWriting(now);
  } catch (...) {
    return failure();
  }
  std::promise<void> end;
  thread_.add([&end] { end.set_value(); });
  end.get_future().wait();
  const auto written = std::exchange(writing_, nullptr);
  object_ = written->object;
  if (!written->isWritten) {
    saved_ = {};
    timer_.start();
    return written->error.isEmpty() ? QStringLiteral("unsaved work: a panel has no positions; undo the last step")
                                    : written->error;
  }
  return {};
}

void Autosave::listen() {
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, [this] {
    ++steps_;
    noticeChange();
  });
  connect(&document_.undoStack(), &QUndoStack::cleanChanged, this, &Autosave::noticeChange);
  connect(&document_.solvers(), &PanelSolvers::frameReady, this, &Autosave::noticeChange);
  layout_.follow(*this, [this] { noticeChange(); });
}

void Autosave::retryLater(const QString& why) {
  saved_ = {};
  timer_.start(std::min(longestRetry, shortestRetry * (1 << std::min(failures_++, 10))));
  const QString sentence = QStringLiteral("Automatic saving failed and is tried again: ") + why;
  if (!why.isEmpty() && failure_ != sentence) {
    reportSuccess();
    failure_ = sentence;
    emit failed(sentence);
  }
}

void Autosave::reportSuccess() {
  if (const QString over = std::exchange(failure_, {}); !over.isEmpty()) {
    emit recovered(over);
  }
}

/// Runs for every frame, so it must be cheap.
void Autosave::noticeChange() {
  changed_ = true;
  if (!closed_ && !writing_ && !timer_.isActive()) {
    timer_.start();
  }
}

Autosave::Mark Autosave::mark() const {
  Mark mark{steps_, {}, layout_.read()};
  for (int panel = 0; panel < document_.panels(); ++panel) {
    const Frame* frame = document_.solvers().frame(panel);
    mark.changed.push_back(frame == nullptr || frame->changed.empty() ? 0 : *std::ranges::max_element(frame->changed));
  }
  return mark;
}

void Autosave::save() {
  if (writing_) {
    changed_ = true;  // its end starts the next one
    return;
  }
  if (document_.moves().isFilming()) {
    timer_.start();  // a film shows other states than that of the work, which changes only after it
    return;
  }
  if (!document_.isModified()) {
    remove();
    return;
  }
  try {
    if (Mark now = mark(); now != saved_) {  // else the frame or the layout changed back
      startWriting(std::move(now));
    }
  } catch (...) {
    retryLater(failure());
  }
}

void Autosave::startWriting(Mark now) {
  changed_ = false;
  begun_ = std::chrono::steady_clock::now();
  const auto writing = std::make_shared<Writing>();
  writing->path = path_;
  writing->object = object_;
  thread_.add([this, writing, draft = SessionDraft(document_, now.layout)] {
    write(*writing, draft);
    announce(this, &Autosave::receive);
  });
  saved_ = std::move(now);
  writing_ = writing;
}

/// Runs on the thread.
void Autosave::write(Writing& writing, const SessionDraft& draft) {
  const Progress& progress = writing.job;
  try {
    writeFiles(writing, draft.finished(progress), progress);
    writing.isWritten = true;
  } catch (const Cancelled&) {
    // The window closes, or the first panel has no positions at this moment.
  } catch (...) {
    writing.error = failure();
  }
  writing.done = true;
}

/// Writes the object, unless its file has it already, and the work.
void Autosave::writeFiles(Writing& writing, Session session, const Progress& progress) {
  const QDir folder(unsaved_work::folder());
  const MeshPointer mesh = written_mesh(session);
  if (writing.object.mesh.lock() != mesh) {
    const int number = writing.object.number + 1;
    Session alone;
    alone.name = session.name;
    alone.mesh = mesh;
    alone.panels.emplace_back();
    save_session(asPath(folder.filePath(unsaved_work::objectName(writing.path, number))), alone, progress.part(0, 0.5),
                 Readers::owner);
    writing.object = {mesh, number};
  }
  const QString name = unsaved_work::objectName(writing.path, writing.object.number);
  session.mesh_file = name.toStdString();
  save_session(asPath(writing.path), session, progress.part(0.5, 1), Readers::owner);
  unsaved_work::discardObjects(writing.path, name);
}

void Autosave::receive() {
  if (closed_ || !writing_ || !writing_->done) {
    return;
  }
  const auto written = std::exchange(writing_, nullptr);
  object_ = written->object;
  if (!written->isWritten) {
    retryLater(written->error);
    return;
  }
  failures_ = 0;
  reportSuccess();
  const auto took = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begun_);
  timer_.setInterval(std::clamp(maxBehind - 2 * took, shortestWait, longestWait));
  if (changed_) {
    timer_.start();
  }
}

void Autosave::remove() {
  unsaved_work::discard(path_);
  saved_ = {};
  object_ = {};
  failures_ = 0;
  reportSuccess();
}

}  // namespace chainmail

#include "io/autosave.h"

#include <QDir>
#include <QFile>
#include <algorithm>
#include <atomic>
#include <future>
#include <iterator>
#include <system_error>
#include <utility>

#include "common/announce.h"
#include "common/application.h"
#include "common/as_path.h"
#include "document/session_draft.h"
#include "files/session/session.h"
#include "io/unsaved_work.h"
#include "mesh/failure.h"
#include "mesh/progress.h"

namespace chainmail {
namespace {

using std::chrono::milliseconds;

// Longest time from a change to the written file: the wait and, at worst, two writes.
constexpr milliseconds maxBehind(4500), shortestWait(500), longestWait(4000);
constexpr milliseconds shortestRetry(10'000), longestRetry(300'000);

/// Returns the memory that writing the work takes at most: the positions of all panels, those of one panel up to four
/// times as they are collected for the file, and some for the rest.
std::size_t memoryFor(const Document& document) {
  constexpr std::size_t rest = 16 * 1024 * 1024;
  const Mesh& mesh = *document.mesh();
  const std::size_t positions = sizeof(double) * std::size_t(mesh.space_dimension) * mesh.element_count();
  return rest + (std::size_t(document.panels()) + 4) * positions;
}

/// Returns a sentence about the exception that is being handled.
std::string failedSentence() noexcept {
  std::string why = failure_sentence("unsaved work");
  try {
    return "Automatic saving failed and is tried again: " + why;
  } catch (...) {
    return why;
  }
}

}  // namespace

struct Autosave::Writing {
  JobState job;
  bool hasEarlier = false;  // true if the file has positions already
  // The thread writes them before it sets `done`; the window reads them after that.
  Object object;  // in its file, before and after
  std::string error;
  bool isWritten = false;
  std::atomic<bool> done = false;
};

Autosave::Autosave(Document& document, LayoutAccess layout, QObject* parent)
    : QObject(parent),
      document_(document),
      layout_(std::move(layout)),
      path_(unsaved_work::newPath()),
      lock_(unsaved_work::lockOf(path_)),
      timer_(this) {
  lock_.setStaleLockTime(0);  // valid as long as the program runs
  lock_.tryLock();
  timer_.setObjectName(QStringLiteral("autosaveTimer"));
  timer_.setSingleShot(true);
  timer_.setInterval(longestWait);
  connect(&timer_, &QTimer::timeout, this, &Autosave::save);
  try {
    thread_.start();
  } catch (const std::system_error&) {
    // The first writing tries it again.
  }
  listen();
  // Later, when somebody listens to failed().
  QMetaObject::invokeMethod(this, &Autosave::holdMemory, Qt::QueuedConnection);
}

Autosave::~Autosave() {
  cancelWriting();
  thread_.finish();
  if (!keeps_) {
    remove();
  }
}

std::vector<Autosave::Adopted> Autosave::takeAdopted(const MeshPointer& mesh) {
  const auto taken = std::stable_partition(adopted_.begin(), adopted_.end(),
                                           [&](const Adopted& work) { return work.mesh.lock() != mesh; });
  std::vector<Adopted> result(std::make_move_iterator(taken), std::make_move_iterator(adopted_.end()));
  adopted_.erase(taken, adopted_.end());
  return result;
}

void Autosave::discardAdopted(const MeshPointer& mesh) {
  for (const Adopted& work : takeAdopted(mesh)) {
    unsaved_work::discard(work.path);
  }
}

void Autosave::cancelWriting() {
  if (writing_) {
    writing_->job.cancelled = true;
  }
}

/// Runs a task after those before, on the thread that writes. If the system starts no thread, this one waits for it.
void Autosave::run(TaskThread::Task task) {
  bool runs = true;
  try {
    thread_.start();
  } catch (const std::system_error&) {
    runs = false;
  }
  if (runs) {
    thread_.add(std::move(task));
  } else {
    task();
  }
}

QString Autosave::keep() {
  const bool isKept = std::exchange(closed_, true);
  timer_.stop();
  if (isKept || !document_.isModified()) {
    return {};
  }
  keeps_ = true;  // before anything can fail: then the files of the last writing stay
  cancelWriting();
  memory_.release();
  std::promise<std::string> failure;
  std::future<std::string> known = failure.get_future();
  try {
    run([&failure, path = path_, draft = SessionDraft(document_, layout_.read())] {
      failure.set_value(keepAs(path, draft));
    });
  } catch (...) {  // no memory for the draft
    failure.set_value(failure_sentence("unsaved work"));
  }
  QString sentence = QString::fromStdString(known.get());
  if (sentence.isEmpty()) {
    discardAdopted(document_.unsplitMesh());
  } else {
    goOn();
  }
  return sentence;
}

/// Writes the work of a closed window. Returns why it failed, or an empty text.
std::string Autosave::keepAs(const QString& path, const SessionDraft& draft) {
  try {
    save_session(asPath(path), draft.finished({}), {}, Readers::owner);
    unsaved_work::discardObjects(path);
    QFile::rename(path, unsaved_work::closedPath(path));
    return {};
  } catch (...) {
    return failure_sentence("unsaved work");
  }
}

/// Saves automatically again, because the window stays open.
void Autosave::goOn() {
  closed_ = keeps_ = false;
  writing_.reset();
  saved_ = {};
  holdMemory();
  timer_.start();
}

bool Autosave::setAside() {
  if (closed_ || !document_.isModified()) {
    return false;
  }
  const QString path = unsaved_work::closedPath(unsaved_work::newPath());
  run([path, draft = SessionDraft(document_, layout_.read())] {
    try {
      save_session(asPath(path), draft.finished({}), {}, Readers::owner);
      unsaved_work::discardOldest();
    } catch (...) {
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
  connect(&document_.solvers(), &PanelSolvers::frameReady, this, &Autosave::noticeChange);
  layout_.follow(*this, [this] { noticeChange(); });
  connect(&document_, &Document::meshChanged, this, &Autosave::holdMemory);
  connect(&document_, &Document::panelsChanged, this, &Autosave::holdMemory);
  if (const Application* application = Application::get()) {
    connect(application, &Application::failed, this, &Autosave::saveSoon);
  }
}

/// Holds the memory for the next writing, unless one is under way. If there is not enough, warns, and writes before
/// there is even less.
void Autosave::holdMemory() {
  if (closed_ || writing_) {
    return;
  }
  const bool isHeld = memory_.hold(memoryFor(document_));
  if (!isHeld && !std::exchange(lacksMemory_, true)) {
    emit failed(QStringLiteral(
        "Memory is almost used up, so unsaved work may not be kept; save it, then close other programs or "
        "use a smaller mesh"));
  }
  lacksMemory_ = !isHeld;
}

void Autosave::retryLater(const QString& sentence) {
  saved_ = {};
  timer_.start(std::min(longestRetry, shortestRetry * (1 << std::min(failures_++, 10))));
  if (!sentence.isEmpty() && failure_ != sentence) {
    reportSuccess();
    failure_ = sentence;
    emit failed(sentence);
  }
  holdMemory();
}

void Autosave::reportSuccess() {
  if (const QString over = std::exchange(failure_, {}); !over.isEmpty()) {
    emit recovered(over);
  }
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
                 progress, Readers::owner);
  }
  return object;
}

/// Runs for every frame, so it must be cheap.
void Autosave::noticeChange() {
  if (closed_) {
    return;
  }
  changed_ = true;
  takeUnannounced();
  if (!writing_ && !timer_.isActive()) {
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

/// Writes at once, because something has failed that may fail again, and worse.
void Autosave::saveSoon() {
  if (!closed_ && !writing_ && document_.isModified()) {
    timer_.start(0);
  }
}

/// Takes over a writing whose end could not be announced, because there was no memory for that.
void Autosave::takeUnannounced() {
  if (writing_ && writing_->done) {
    receive();
  }
}

void Autosave::save() {
  takeUnannounced();
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
    startWriting();
  } catch (...) {  // no memory for the draft
    retryLater(QString::fromStdString(failedSentence()));
  }
}

void Autosave::startWriting() {
  Mark now = mark();
  if (now == saved_) {
    return;  // the frame or the layout changed back
  }
  changed_ = false;
  begun_ = std::chrono::steady_clock::now();
  memory_.release();
  const auto writing = std::make_shared<Writing>();
  writing->hasEarlier = hasPositions_;
  writing->object = object_;
  run([this, writing, draft = SessionDraft(document_, now.layout)] { write(*writing, draft); });
  saved_ = std::move(now);
  writing_ = writing;
}

void Autosave::write(Writing& writing, const SessionDraft& draft) {
  const Progress progress(writing.job);
  try {
    writing.object = writeFiles(draft.finished(progress), writing.object, progress);
    writing.isWritten = true;
  } catch (const Cancelled&) {
    // The window closes, or the first panel has no positions at this moment.
  } catch (const std::bad_alloc&) {
    writing.error = writeMoves(writing, draft, progress);
  } catch (...) {
    writing.error = failedSentence();
  }
  writing.done = true;
  announce(this, &Autosave::receive);
}

/// Writes the object, unless its file has it already, and the work. Returns the object that is written.
Autosave::Object Autosave::writeFiles(Session session, const Object& object, const Progress& progress) const {
  Object written = withObject(path_, session, object, progress.part(0, 0.5));
  const QString name = unsaved_work::objectName(path_, written.number);
  session.mesh_file = name.toStdString();
  save_session(asPath(path_), session, progress.part(0.5, 1), Readers::owner);
  unsaved_work::discardObjects(path_, name);
  return written;
}

/// Writes the work without positions when there is no memory for them, unless an earlier file has some. Returns the
/// sentence for the user.
std::string Autosave::writeMoves(Writing& writing, const SessionDraft& draft, const Progress& progress) const {
  std::string sentence = failedSentence();
  try {
    if (!writing.hasEarlier) {
      writing.object = writeFiles(draft.withoutPositions(), writing.object, progress);
      sentence =
          "Automatic saving kept the moves, but had no memory for the positions; save your work, then close other "
          "programs or use a smaller mesh";
    }
  } catch (...) {
    // The first sentence says it.
  }
  return sentence;
}

void Autosave::receive() {
  if (closed_ || !writing_ || !writing_->done) {
    return;
  }
  const auto written = std::exchange(writing_, nullptr);
  object_ = written->object;
  if (!written->isWritten) {
    retryLater(QString::fromStdString(written->error));
    return;
  }
  failures_ = 0;
  reportSuccess();
  hasPositions_ = true;
  const auto took = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begun_);
  timer_.setInterval(std::clamp(maxBehind - 2 * took, shortestWait, longestWait));
  if (changed_) {
    timer_.start();
  }
  holdMemory();
}

void Autosave::adopt(const QString& path, std::unique_ptr<QLockFile> lock, const MeshPointer& mesh) {
  adopted_.push_back({path, std::move(lock), mesh});
}

void Autosave::remove() {
  unsaved_work::discard(path_);
  saved_ = {};
  object_ = {};
  hasPositions_ = false;
  failures_ = 0;
  reportSuccess();
}

}  // namespace chainmail

#pragma once

#include <QLockFile>
#include <QObject>
#include <QTimer>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "common/held_memory.h"
#include "common/task_thread.h"
#include "document/document.h"

namespace chainmail {

class SessionDraft;

/// Reads and sets how the window shows its object: cameras, colours, docks. A session keeps it as JSON that only the
/// window interprets.
struct LookAccess {
  std::function<std::string()> read;
  /// Parts that the look lacks stay unchanged.
  std::function<void(const std::string& look)> set;
  /// Calls `changed` whenever the result of `read` changes, while `context` exists.
  std::function<void(QObject& context, const std::function<void()>& changed)> follow;
};

/// Saves unsaved work in the background, at most 4.5 s after a change. Writes only what changed: the object has a file
/// of its own, which stays until another object is open. Each file is written completely or not at all. A lock shows
/// whether the program still runs or has crashed. The files are removed once the user has saved the work. The window's
/// look is part of the work, but a change of the look alone is not saved.
///
/// One thread writes, from the start to the end: when the system has no more threads, this one is there. The memory
/// that a writing takes is held in between. If a writing fails nevertheless, it is tried again some seconds later, and
/// earlier files stay. After each failure that the application reports, the work is written at once.
class Autosave : public QObject {
  Q_OBJECT

 public:
  Autosave(Document& document, LookAccess look, QObject* parent);
  /// Removes the files, unless keep() was called.
  ~Autosave() override;

  /// Keeps unsaved work for the next start. Call it when the window closes; later changes are not saved. Writing runs
  /// in the background, and the destructor waits for it.
  void keep();

  /// Keeps unsaved work for the next start, because another object is about to replace it. Writing runs in the
  /// background. Returns false if there is none.
  bool setAside();

  /// Takes over work that this window has restored. Its files are removed when this window has saved it again.
  void adopt(const QString& path, std::unique_ptr<QLockFile> lock);

 signals:
  /// Emitted when saving fails; `sentence` says why. While it fails again for the same reason, there is no other.
  void failed(const QString& sentence);

 private:
  struct Writing;
  /// The object that a file has.
  struct Object {
    std::weak_ptr<const Mesh> mesh;
    int number = 0;  // of the file
  };
  struct Adopted {
    QString path;
    std::unique_ptr<QLockFile> lock;
  };
  /// Identifies a state of the work.
  struct Mark {
    std::uint64_t steps = 0;             // number of edits, undos and redos
    std::vector<std::uint64_t> changed;  // per panel: number of the last frame that changed a position
    std::string look;                    // cameras, colours, docks

    bool operator==(const Mark&) const = default;
  };

  static Object withObject(const QString& path, const Session& session, Object object, const Progress& progress);
  static void discardAll(std::vector<Adopted>& adopted);
  void listen();
  void noticeChange();
  void save();
  void startWriting();
  void takeUnannounced();
  void saveSoon();
  void receive();
  void reportFailure(const QString& sentence);
  void remove();
  void cancelWriting();
  void run(TaskThread::Task task);
  void write(Writing& writing, const SessionDraft& draft);
  Object writeFiles(Session session, const Object& object, const Progress& progress) const;
  std::string writeMoves(Writing& writing, const SessionDraft& draft, const Progress& progress) const;
  void holdMemory();
  Mark mark() const;

  Document& document_;
  const LookAccess look_;
  const QString path_;  // also read by the thread
  QLockFile lock_;
  QTimer timer_;
  std::uint64_t steps_ = 0;
  Mark saved_;
  Object object_;
  std::vector<Adopted> adopted_;
  bool hasPositions_ = false;  // true if the file has positions, not only moves
  bool keeps_ = false;         // the files stay when this ends
  bool changed_ = false;       // true if the work changed during writing
  QString failure_;            // the last sentence of failed(); empty after a writing that did not fail
  bool closed_ = false;        // the window is closed: later changes are not saved
  std::chrono::steady_clock::time_point begun_;
  std::shared_ptr<Writing> writing_;  // null while nothing is being written; shared with the thread
  HeldMemory memory_;                 // for the next writing
  bool lacksMemory_ = false;          // true if so much could not be held
  TaskThread thread_;                 // last: ends before the members that its tasks use
};

}  // namespace chainmail

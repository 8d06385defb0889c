#pragma once

#include <QLockFile>
#include <QObject>
#include <QTimer>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "common/jobs.h"
#include "document/document.h"

namespace chainmail {

class Progress;
class SessionDraft;
struct Session;

/// Reads and sets how the window shows its object: cameras, colours, docks. A session keeps it as JSON that only the
/// window interprets.
struct LayoutAccess {
  std::function<std::string()> read;
  /// Parts that the layout lacks stay unchanged.
  std::function<void(const std::string& layout)> set;
  /// Calls `changed` whenever the result of `read` changes, while `context` exists.
  std::function<void(QObject& context, const std::function<void()>& changed)> follow;
};

/// Saves unsaved work in the background, at most 4.5 s after a change. Writes only what changed: the object has a file
/// of its own, which stays until another object is open. Each file is written completely or not at all, and only the
/// user may read it. A lock shows whether the program still runs or has crashed. The files are removed once the user
/// has saved the work. The window's layout is part of the work, but a change of the layout alone is not saved. If a
/// writing fails, earlier files stay, and it is tried again after 10 s, 20 s and so on, up to five minutes.
class Autosave : public QObject {
  Q_OBJECT

 public:
  Autosave(Document& document, LayoutAccess layout, QObject* parent);
  /// Removes the files, unless keep() was called.
  ~Autosave() override;

  /// Keeps unsaved work for the next start, and waits until it is written. Call it when the window closes; later
  /// changes are not saved. Returns why the work could not be written, as a sentence; otherwise an empty text. After a
  /// failure the window may stay open, and saving goes on.
  QString keep();
  /// The same before another object replaces this one: the files of the work stay until the user has saved it after
  /// Undo, and what follows has files of its own.
  QString setAside();

  /// True while a file is being written in the background.
  bool isWriting() const { return writing_ != nullptr; }

  /// Takes over the lock of work that this window has restored. Its files stay, whatever happens to this window, until
  /// the user has saved an object that comes from `mesh`, or the window keeps one.
  void adopt(const QString& path, std::unique_ptr<QLockFile> lock, const MeshPointer& mesh);
  /// Removes restored work whose object comes from `mesh`, because the user has saved it.
  void discardAdopted(const MeshPointer& mesh);

 signals:
  /// Emitted when saving fails; `sentence` says why. While it fails again for the same reason, there is no other.
  void failed(const QString& sentence);
  /// Emitted when `sentence` of failed() is no longer true: saving works again.
  void recovered(const QString& sentence);

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
    std::weak_ptr<const Mesh> mesh;
  };
  /// Identifies a state of the work.
  struct Mark {
    std::uint64_t steps = 0;             // number of edits, undos and redos
    std::vector<std::uint64_t> changed;  // per panel: number of the last frame that changed a position
    std::string layout;                  // cameras, colours, docks

    bool operator==(const Mark&) const = default;
  };

  void begin();
  void listen();
  void noticeChange();
  void save();
  void startWriting(Mark now);
  static void write(Writing& writing, const SessionDraft& draft);
  static void writeFiles(Writing& writing, Session session, const Progress& progress);
  void receive();
  void retryLater(const QString& why);
  void reportSuccess();
  void remove();
  void cancelWriting();
  QString handOver();
  QString writeNow();
  Mark mark() const;

  Document& document_;
  const LayoutAccess layout_;
  QString path_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  std::uint64_t steps_ = 0;
  Mark saved_;
  Object object_;
  std::vector<Adopted> adopted_;
  bool keeps_ = false;    // the files stay when this ends
  bool changed_ = false;  // true if the work changed during writing
  QString failure_;       // the last sentence of failed(); empty after a writing that did not fail
  int failures_ = 0;      // in a row
  bool closed_ = false;   // the window is closed: later changes are not saved
  std::chrono::steady_clock::time_point begun_;
  std::shared_ptr<Writing> writing_;  // null while nothing is being written; shared with the thread
  TaskThread thread_;                 // last: ends before the members that its tasks use
};

}  // namespace chainmail

#pragma once

#include <QLockFile>
#include <QObject>
#include <QTimer>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "document/document.h"

namespace chainmail {

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
  /// Emitted when saving fails; `sentence` says why.
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
  void receive();
  void remove();
  void endWriting();
  Mark mark() const;

  Document& document_;
  const LookAccess look_;
  QString path_;
  QLockFile lock_;
  QTimer timer_;
  std::uint64_t steps_ = 0;
  Mark saved_;
  Object object_;
  std::vector<Adopted> adopted_;
  bool changed_ = false;  // true if the work changed during writing
  bool broken_ = false;
  bool closed_ = false;  // the window is closed: later changes are not saved
  std::chrono::steady_clock::time_point begun_;
  std::shared_ptr<Writing> writing_;  // null while nothing is being written; shared with the thread
  std::jthread thread_;
  std::jthread aside_;  // writes work that was set aside
};

}  // namespace chainmail

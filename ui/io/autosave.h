#pragma once

#include <QLockFile>
#include <QObject>
#include <QTimer>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "document/document.h"
#include "io/look_access.h"

namespace chainmail {

/// Keeps a window's unsaved work on the disk, at most some seconds behind: written in the background, whole or not at
/// all, beside a lock that tells a program that runs from one that has crashed. While nothing changes it does nothing;
/// what is saved is taken away. The window's look is written with the work; a look alone is not work.
class Autosave : public QObject {
  Q_OBJECT

 public:
  /// Where all programs of a user keep theirs; made where it is missing.
  static QString folder();
  /// The lock that belongs to a file there.
  static QString lockOf(const QString& path) { return path + QStringLiteral(".lock"); }
  /// Whether a file is the unsaved work of a window that was closed, not of one that crashed.
  static bool isClosed(const QString& path);

  Autosave(Document& document, LookAccess look, QObject* parent);
  /// Nothing is left behind but what was kept.
  ~Autosave() override;

  /// To be called when the window is closed: nobody is asked, since what is unsaved is there at the next start. A large
  /// object is written after the window has gone; the destructor waits for it. Later changes are not kept.
  void keep();

  /// Takes a file over that another program left; it is this window's work now.
  void adopt(const QString& path);

 signals:
  /// Work is not kept safe: one sentence.
  void failed(const QString& sentence);

 private:
  struct Writing;
  /// What tells one state of the work from another.
  struct Mark {
    std::uint64_t steps = 0;             // of undo, redo and doing
    std::vector<std::uint64_t> changed;  // the newest frame of each panel in which a position changed
    std::string look;                    // of the window: cameras, colours, docks

    bool operator==(const Mark&) const = default;
  };

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
  bool changed_ = false;  // while it was being written
  bool broken_ = false;
  bool closed_ = false;  // the window has closed: what it still does is not kept
  std::chrono::steady_clock::time_point begun_;
  std::shared_ptr<Writing> writing_;  // while something is; shared with its thread
  std::jthread thread_;
};

}  // namespace chainmail

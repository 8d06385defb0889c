#pragma once

#include <QObject>
#include <QString>
#include <cstdint>
#include <map>
#include <optional>

#include "common/jobs.h"
#include "document/document.h"
#include "document/edits.h"
#include "files/session/session.h"
#include "io/autosave.h"

namespace chainmail {

class RecoveryBar;

/// What tells the content of a file from another one without reading it.
struct FileState {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t changedSeconds = 0, changedNanoseconds = 0;

  bool operator==(const FileState&) const = default;
};

/// Returns the state of a file; none if it does not exist.
std::optional<FileState> stateOf(const QString& path);

/// Knows the files that this window has read and written, so that it does not overwrite what another window or program
/// has written to them since.
class KnownFiles {
 public:
  /// The window knows the content that the file had in this state.
  void know(const QString& path, const std::optional<FileState>& state);
  /// True if the file exists and is not as the window knows it. False for a file that the window does not know.
  bool isChanged(const QString& path) const;

 private:
  std::map<QString, FileState> known_;
};

/// Sessions of a window: opens and saves them in the background, saves unsaved work automatically, and offers it at the
/// next start.
class Sessions : public QObject {
  Q_OBJECT

 public:
  Sessions(Document& document, Jobs& jobs, LayoutAccess layout, QObject* parent);
  ~Sessions() override;

  /// Reads a session in the thread of a job. The returned function shows it in the window.
  Jobs::Finish read(RegularFile file, const QString& path, edits::Opening opening, const Progress& progress);
  /// Saves the session in the background.
  void savePath(const QString& path);
  /// The window has read or written a file, which was in this state then.
  void know(const QString& path, const std::optional<FileState>& state);
  /// True if another program has changed this file since the window opened or saved it.
  bool isChangedOutside(const QString& path) const;

  /// Returns the bar that offers unsaved work from earlier windows.
  RecoveryBar& recoveryBar() { return *recovery_; }
  /// Starts automatic saving, and offers unsaved work from earlier windows. Most tests do not call it.
  void protect();
  /// Keeps unsaved work for the next start. Call it when the user closes the window. Returns why the work could not be
  /// kept, as a sentence; otherwise an empty text.
  QString keep();
  /// The same before another object replaces the present one.
  QString setAside();
  /// Stops automatic saving, and removes discarded work.
  void close();

 signals:
  void failed(const QString& sentence);
  /// Emitted when `sentence` of failed() is no longer true.
  void recovered(const QString& sentence);
  /// Emitted with a sentence about unsaved work that was replaced or discarded.
  void noted(const QString& sentence);
  void saved(const QString& path);
  void opened(const QString& path);

 private:
  void restore(const QString& path);

  Document& document_;
  Jobs& jobs_;
  const LayoutAccess layout_;
  std::uint64_t steps_ = 0;  // number of edits, undos and redos
  RecoveryBar* recovery_;
  KnownFiles files_;
  std::unique_ptr<Autosave> autosave_;
};

}  // namespace chainmail

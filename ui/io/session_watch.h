#pragma once

#include <QFileSystemWatcher>
#include <QTimer>
#include <cstdint>
#include <map>
#include <optional>

#include "document/document.h"

namespace chainmail {

/// What tells the content of a file from another one without reading it.
struct FileState {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t changedSeconds = 0, changedNanoseconds = 0;

  bool operator==(const FileState&) const = default;
};

/// Returns the state of a file; none if it does not exist.
std::optional<FileState> stateOf(const QString& path);

/// Knows the sessions that this window has read and written, so that it does not overwrite what another window or
/// program has written to them since. Watches the session of the document, or the mesh file that it was opened from.
class SessionWatch : public QObject {
  Q_OBJECT

 public:
  explicit SessionWatch(Document& document, QObject* parent);

  /// The window knows the content that the file had in this state.
  void know(const QString& path, const std::optional<FileState>& state);
  /// True if the file exists and is not as the window knows it. False for a file that the window does not know.
  bool isChanged(const QString& path) const;

 signals:
  /// Emitted when another file is watched, or none.
  void followed();
  /// Emitted once for each change of the document's file by another program.
  void changedOutside(const QString& path);

 private:
  const QString& path() const;
  void follow();
  void look();

  Document& document_;
  QString followed_;
  std::map<QString, FileState> known_;
  std::optional<FileState> told_;
  QFileSystemWatcher watcher_;
  QTimer calm_;  // another program may write in several steps
};

}  // namespace chainmail

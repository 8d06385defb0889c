#pragma once

#include <QString>
#include <cstdint>
#include <map>
#include <optional>

namespace chainmail {

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

}  // namespace chainmail

#pragma once

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

#include "mesh/error.h"

namespace chainmail {

/// The error for a write that started and could not be finished, for example on a full disk.
class WriteFailure : public Error {
 public:
  using Error::Error;
};

/// The error for a file that may be written, but not replaced: its folder takes no new file, or the file is mounted, or
/// belongs to another user in a sticky folder. write_in_place() may still write it.
class NotReplaceable : public Error {
 public:
  using Error::Error;
};

/// Who may read a file that did not exist: as the user's umask says, or only the owner.
enum class Readers { as_usual, owner };

/// The new content of one file. It replaces the old content as a whole or not at all, even if the program is killed or
/// the machine loses power.
///
/// The content is written to a file without a name in the folder of the target, of which a killed program leaves
/// nothing (Linux, O_TMPFILE). Other file systems get a file `.chainmail-N.tmp`. Such files of a killed program are
/// removed a day later, by the next write into that folder. An existing target keeps its owner, group, permissions and
/// extended attributes as far as the system allows it, but not its set-user-ID.
class Replacement {
 public:
  /// `path` is what the user entered, for messages; `target` is the same without symbolic links. Throws NotReplaceable
  /// or Error if no file can be made there.
  Replacement(std::filesystem::path path, std::filesystem::path target, Readers readers = Readers::as_usual);
  /// Takes over a file that another writer has made on the same file system. Throws Error if it is not there.
  Replacement(std::filesystem::path path, std::filesystem::path target, std::filesystem::path made);
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  /// Removes the new content unless it was put in place.
  ~Replacement();

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& target() const { return target_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// Takes the content; not for a file that was taken over.
  std::ostream& stream();

  /// Waits until the disk has the content. Throws WriteFailure if it does not.
  void finish();
  /// Gives the content a name in the folder of the target. Call this after finish().
  void name();
  /// Replaces the target. With `keeps_old`, take_back() gives the old content back until this object ends; without it,
  /// the target is never missing. Throws WriteFailure or NotReplaceable.
  void put(bool keeps_old);
  void take_back();
  /// Waits until the disk has the new names in the folder. Throws WriteFailure if the disk fails.
  void sync_folder() const;

 private:
  class Buffer;
  enum class State { unnamed, named, added, exchanged, backed_up, replaced };

  void open_unnamed(int mode);
  void open_named(int mode);
  void keep_properties() const;
  bool exchange() const;
  std::filesystem::path free_name() const;
  void close_descriptor();
  [[noreturn]] void fail_to_write() const;
  [[noreturn]] void fail_to_replace() const;

  std::filesystem::path path_;
  std::filesystem::path target_;
  std::filesystem::path folder_;
  std::filesystem::path temporary_;  // the new content, or after exchange() the old one
  std::filesystem::path backup_;     // the old content
  int descriptor_ = -1;
  std::unique_ptr<Buffer> buffer_;
  std::unique_ptr<std::ostream> stream_;
  State state_ = State::unnamed;
};

/// Writes an existing file without replacing it, for files that are NotReplaceable. The space is reserved first, but if
/// the disk fails, the old content is lost.
void write_in_place(const std::filesystem::path& path, const std::string& content);

}  // namespace chainmail

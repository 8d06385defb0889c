#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <set>
#include <vector>

#include "mesh/error.h"

namespace chainmail {

/// The error for a write that started and could not be finished, for example on a full disk.
class WriteFailure : public Error {
 public:
  using Error::Error;
};

/// Who may read a file that did not exist: as the user's umask says, or only the owner. An existing file keeps its
/// permissions.
enum class Readers { as_usual, owner };

/// Writes one or more files, each of them completely or not at all, even if the program is killed or the machine loses
/// power.
///
/// add() writes the content into a file `.chainmail-N.tmp` beside its target, and waits until the disk has it; commit()
/// renames all of them to their targets. If one cannot be written, none is replaced. A symbolic link stays, and the
/// file that it points to is replaced; a hard link is replaced, so that its other names keep the old content. The path
/// `-` means standard output. Standard output, devices and pipes receive their text in commit(), before the first file
/// is replaced.
class Outputs {
 public:
  using Writer = std::function<void(std::ostream&)>;

  Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  ~Outputs();

  /// Protects an input file: no output may replace it, under this name or another. Call this before add().
  void keep(const std::filesystem::path& input);
  /// Writes the content of a file. Throws Error if the target cannot be written.
  void add(const std::filesystem::path& path, Writer writer, Readers readers = Readers::as_usual);
  /// Takes over a finished file of another writer, on the file system of its target `path`.
  void take(const std::filesystem::path& path, const std::filesystem::path& made);
  void commit();

 private:
  class Replacement;
  struct Stream {
    std::filesystem::path path;
    Writer writer;
  };

  bool is_input(const std::filesystem::path& output) const;
  void write_streams();
  void refuse_twice(const std::filesystem::path& path, const std::filesystem::path& target);

  std::vector<std::filesystem::path> inputs_;
  std::set<std::filesystem::path> targets_;  // of files_ and of streams_
  std::vector<std::unique_ptr<Replacement>> files_;
  std::vector<Stream> streams_;
};

/// Writes one file. If writing fails, the old file stays.
void write_file(const std::filesystem::path& path, const Outputs::Writer& writer, Readers readers = Readers::as_usual);

}  // namespace chainmail

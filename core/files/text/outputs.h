#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <set>
#include <vector>

#include "files/text/replacement.h"

namespace chainmail {

/// Writes several files together: all of them or none.
///
/// add() writes the content of each file beside its target, and waits until the disk has it (see Replacement). commit()
/// then replaces all targets; if one cannot be replaced, the others get their old content back. Only if the machine
/// stops between two replacements, some files are new and others old, each of them whole. The path `-` means standard
/// output. Standard output, devices and pipes receive their text in commit(), before the first replacement.
class Outputs {
 public:
  using Writer = std::function<void(std::ostream&)>;

  Outputs() = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// Protects an input file: no output may replace it, under this name or another. The path `-` means the file that is
  /// read as standard input, if it is one. Call this before add().
  void keep(const std::filesystem::path& input);
  /// Writes the content of a file. Throws Error if the target cannot be written, NotReplaceable if it cannot be
  /// replaced.
  void add(const std::filesystem::path& path, Writer writer, Readers readers = Readers::as_usual);
  /// Takes over a finished file of another writer, on the file system of its target `path`.
  void take(const std::filesystem::path& path, const std::filesystem::path& made);
  void commit();

 private:
  struct Stream {
    std::filesystem::path path;
    Writer writer;
  };

  bool is_input(const std::filesystem::path& output) const;
  void write_streams();
  void replace_all();
  void sync_folders();
  void refuse_twice(const std::filesystem::path& path, const std::filesystem::path& target);

  std::vector<std::filesystem::path> inputs_;
  std::set<std::filesystem::path> targets_;  // of files_ and of streams_
  std::vector<std::unique_ptr<Replacement>> files_;
  std::vector<Stream> streams_;
};

/// Writes one file. If writing fails, the old file stays.
void write_file(const std::filesystem::path& path, const Outputs::Writer& writer, Readers readers = Readers::as_usual);

}  // namespace chainmail

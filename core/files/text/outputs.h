#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "mesh/error.h"

namespace chainmail {

/// The error for a write that started and could not be finished, for example on a full disk.
class WriteFailure : public Error {
 public:
  using Error::Error;
};

/// Writes several files together: all of them or none.
///
/// Each text is first written to a temporary file in the folder of its target. Then commit() renames all temporary
/// files. The path `-` means standard output. Standard output, devices and pipes receive their text in commit(), before
/// the first rename.
class Outputs {
 public:
  using Writer = std::function<void(std::ostream&)>;

  Outputs() = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  /// Removes temporary files that were not committed.
  ~Outputs();

  /// Protects an input file: no output may replace it. Call this before add().
  void keep(const std::filesystem::path& input);
  /// Writes the text of a file to its temporary file. Throws Error if the target cannot be written.
  void add(const std::filesystem::path& path, Writer writer);
  void commit();

 private:
  struct File {
    std::filesystem::path path;  // the path that the user entered
    std::filesystem::path target;
    std::filesystem::path temporary;
  };
  struct Stream {
    std::filesystem::path path;
    Writer writer;
  };

  void refuse_twice(const std::filesystem::path& path, const std::filesystem::path& target) const;

  std::vector<std::filesystem::path> inputs_;  // with symbolic links resolved
  std::vector<File> files_;
  std::vector<Stream> streams_;
};

/// Writes one file. If writing fails, the old file stays.
void write_file(const std::filesystem::path& path, const Outputs::Writer& writer);

}  // namespace chainmail

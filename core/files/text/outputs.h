#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "mesh/error.h"

namespace chainmail {

/// A write that started and could not be finished: a full disk, a closed pipe.
class WriteFailure : public Error {
 public:
  using Error::Error;
};

/// Files that are written together: all of them or none.
///
/// Each file is first written to a temporary file in the folder of its target; commit() then renames all. The path `-`
/// is standard output. Standard output, devices and pipes receive their text in commit(), before the first rename.
class Outputs {
 public:
  using Writer = std::function<void(std::ostream&)>;

  Outputs() = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  /// Removes the temporary files that were not committed.
  ~Outputs();

  /// Protects a file that was read: no output may replace it. Call this before add().
  void keep(const std::filesystem::path& input);
  /// Writes the text of a file to its temporary file. Throws Error if the target cannot be written.
  void add(const std::filesystem::path& path, Writer writer);
  void commit();

 private:
  struct File {
    std::filesystem::path path;  // as the user named it
    std::filesystem::path target;
    std::filesystem::path temporary;
  };
  struct Stream {
    std::filesystem::path path;
    Writer writer;
  };

  void refuse_twice(const std::filesystem::path& path, const std::filesystem::path& target) const;

  std::vector<std::filesystem::path> inputs_;  // with links resolved
  std::vector<File> files_;
  std::vector<Stream> streams_;
};

/// Writes one file. A failed write leaves the file as it was.
void write_file(const std::filesystem::path& path, const Outputs::Writer& writer);

}  // namespace chainmail

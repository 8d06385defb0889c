#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <vector>

#include "mesh/error.h"

namespace chainmail {

/// A file that could be begun and not be finished: a full disk, a closed pipe.
class WriteFailure : public Error {
 public:
  using Error::Error;
};

/// Files that are written together: all of them, each whole, or none.
///
/// Each goes to a temporary beside its target first; commit then renames them all. The path `-` is
/// standard output; it, devices and pipes receive their text in commit, before the first rename.
class Outputs {
 public:
  using Writer = std::function<void(std::ostream&)>;

  Outputs() = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  /// Removes the temporaries of what was not committed.
  ~Outputs();

  /// Names a file that was read: no output may replace it. Before the outputs are added.
  void keep(const std::filesystem::path& input);
  /// Writes a file's text aside. Throws Error where the target cannot be a file of ours.
  void add(const std::filesystem::path& path, Writer writer);
  void commit();

 private:
  struct File {
    std::filesystem::path path;  // as it was named
    std::filesystem::path target;
    std::filesystem::path temporary;
  };
  struct Stream {
    std::filesystem::path path;
    Writer writer;
  };

  void refuse_twice(const std::filesystem::path& path, const std::filesystem::path& target) const;

  std::vector<std::filesystem::path> inputs_;  // where they lead
  std::vector<File> files_;
  std::vector<Stream> streams_;
};

/// Writes one file, whole or not at all.
void write_file(const std::filesystem::path& path, const Outputs::Writer& writer);

}  // namespace chainmail

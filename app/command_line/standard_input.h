#pragma once

#include <filesystem>
#include <optional>

#include "chainmail/error.h"
#include "chainmail/files.h"

namespace chainmail::command_line {

/// A file that the user names. The name `-` is standard input, whose bytes are written to a temporary file, because
/// readers look at a file more than once.
class InputFile {
 public:
  /// Reads standard input if it is named. Throws Error if it is larger than api::largest_file, WriteFailure if there
  /// is no place for it.
  explicit InputFile(const std::filesystem::path& named);

  const std::filesystem::path& path() const { return path_; }
  /// Calls open(path) and returns its result. Errors about the temporary file name standard input.
  template <class Open>
  auto read(Open open) const {
    try {
      return open(path_);
    } catch (const api::Error& error) {
      throw named(error);
    }
  }

 private:
  api::Error named(const api::Error& error) const;

  std::optional<api::TemporaryFolder> folder_;
  std::filesystem::path path_;
};

}  // namespace chainmail::command_line

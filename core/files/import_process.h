#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "files/imported.h"
#include "mesh/progress.h"

namespace chainmail {

/// What the import program may take.
struct ImportLimits {
  std::uint64_t bytes = 0;  // of memory
  unsigned seconds = 120;   // of a processor's time
};

/// The limits for reading a file: a small multiple of its size, and what the libraries themselves need.
ImportLimits limits_for(const std::filesystem::path& path);

/// Has the import program read a file, or work on one: libraries that crash or hang on damaged files do so in a
/// process of their own, within limits, and are gone at once when cancelled.
///
/// `task` is a word that the program knows, `arguments` follow the path. Throws Error, said of `path`, where the
/// program refuses the file, crashes on it, exceeds a limit or is not there; and Cancelled.
Imported run_import(const std::string& task, const std::filesystem::path& path,
                    const std::vector<std::string>& arguments, const ImportLimits& limits, const Progress& progress);

}  // namespace chainmail

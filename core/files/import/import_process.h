#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/formats/imported.h"
#include "files/import/import_input.h"
#include "mesh/progress.h"

namespace chainmail {

/// What the import program may take.
struct ImportLimits {
  std::uint64_t bytes = 0;  // of memory
  unsigned seconds = 120;   // of a processor's time
  unsigned wall_seconds = 600;
};

/// The limits for reading so many bytes: a small multiple of them, and what the libraries themselves need.
ImportLimits limits_for(std::uint64_t size);

/// Has the import program read a file, or work on one: libraries that crash or hang on damaged files do so in a
/// process of their own, in a sandbox (files/import/sandbox.h), within limits, and are gone at once when cancelled.
///
/// `task` is a word that the program knows, `arguments` follow the path. Throws Error, which names the input, where the
/// program refuses the file, crashes on it, exceeds a limit or is not there; and Cancelled.
Imported run_import(const std::string& task, const ImportInput& input, const std::vector<std::string>& arguments,
                    const ImportLimits& limits, const Progress& progress);

}  // namespace chainmail

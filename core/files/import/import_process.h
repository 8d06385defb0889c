#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "files/import/handover.h"
#include "files/import/import_input.h"
#include "mesh/progress.h"

namespace chainmail {

/// Limits of the import program.
struct ImportLimits {
  std::uint64_t bytes = 0;  // of memory
  unsigned seconds = 120;   // of processor time
  unsigned wall_seconds = 600;
};

/// Returns the limits for reading a file of this size (bytes). Memory grows with the size, on top of what the libraries
/// themselves need. Limits of this process also limit the import program.
ImportLimits limits_for(std::uint64_t size);

/// Runs a task of the import program on a file. Libraries may crash or hang on damaged files: they run in a process of
/// their own, in a sandbox (files/import/sandbox.h), within limits. Cancelling ends the process at once.
///
/// `task` is a word that the program knows; `arguments` follow the path. `program` is the path of the program; if it is
/// empty or there is no such file, the program is found next to this one, or where an installation has it. Throws
/// Error, which names the input, if the program refuses the file, crashes, exceeds a limit or is missing; and
/// Cancelled.
Imported run_import(const std::string& task, const ImportInput& input, const std::vector<std::string>& arguments,
                    const ImportLimits& limits, const Progress& progress, const std::filesystem::path& program = {});

/// Runs a task as run_import does, and returns its result, which must be of this kind: ImportedMesh or Volume. Throws
/// Error if it is of another kind.
template <class Kind>
Kind run_import_of(const std::string& task, const ImportInput& input, const std::vector<std::string>& arguments,
                   const ImportLimits& limits, const Progress& progress, const std::filesystem::path& program = {}) {
  Imported imported = run_import(task, input, arguments, limits, progress, program);
  if (Kind* wanted = std::get_if<Kind>(&imported)) {
    return std::move(*wanted);
  }
  throw damaged_answer(input.shown_as());
}

}  // namespace chainmail

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "files/import/handover.h"
#include "files/text/regular_file.h"
#include "files/text/temporary_folder.h"
#include "mesh/progress.h"

namespace chainmail {

/// The input of an import: a private folder with only its files, under names that we choose. Libraries depend on names,
/// and look for other files in the same folder: Gmsh runs the commands in FILE.opt.
class ImportInput {
 public:
  /// Errors name `shown_as`. The library reads each file `passes` times, which is used to compute progress.
  explicit ImportInput(std::filesystem::path shown_as, int passes = 1)
      : shown_as_(std::move(shown_as)), passes_(passes) {}

  /// Adds a link to a file, without a copy. The import program inherits the open file, so a file that replaces it at
  /// its path is not read. Throws WriteFailure if the disk is full.
  void link(const std::string& name, RegularFile file);
  /// Adds a file with these bytes. Throws WriteFailure if the disk is full.
  void write(const std::string& name, std::string_view bytes);

  const std::filesystem::path& shown_as() const { return shown_as_; }
  const std::filesystem::path& folder() const { return folder_.path(); }
  /// The file that was added first. The import program reads it.
  std::filesystem::path main_file() const { return folder() / main_name_; }
  const std::vector<RegularFile>& linked() const { return linked_; }
  /// Size of the linked files (bytes).
  std::uint64_t linked_size() const;
  /// Number of bytes that the library will read from linked files.
  double bytes_to_read() const { return passes_ * double(linked_size()); }

 private:
  void name_first(const std::string& name);

  std::filesystem::path shown_as_;
  TemporaryFolder folder_;
  int passes_;
  std::string main_name_;
  std::vector<RegularFile> linked_;
};

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

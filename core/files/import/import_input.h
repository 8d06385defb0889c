#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/text/regular_file.h"
#include "files/text/temporary_folder.h"

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

}  // namespace chainmail

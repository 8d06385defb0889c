#pragma once

#include <filesystem>
#include <vector>

namespace chainmail::command_line {

/// A folder for results, made where it is missing, and unmade where the results did not come.
class OutputFolder {
 public:
  /// Touches nothing yet. Throws Error where there can be no such folder, so that nobody waits for results
  /// that have no place to go.
  explicit OutputFolder(std::filesystem::path path);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  /// Removes what was made and not kept.
  ~OutputFolder();

  void make();
  void keep() { made_.clear(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // the outermost first
};

}  // namespace chainmail::command_line

#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace chainmail::command_line {

/// A folder for results. It is created if it is missing, and removed again if the results are not written.
class OutputFolder {
 public:
  /// Throws Error if the folder cannot be created, so that a wrong name is found before any long work. Does not create
  /// it yet.
  explicit OutputFolder(std::filesystem::path path);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  /// Removes the folders that were created, unless keep() was called.
  ~OutputFolder();

  void make();
  void keep() { made_.clear(); }
  /// Notes on standard error which plots in the folder are of an earlier report: the new one, with the plots `written`,
  /// has not replaced them. They stay, because only the user knows whether somebody needs them.
  void say_older_plots(const std::set<std::string>& written) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // outermost first
};

}  // namespace chainmail::command_line

#pragma once

#include <filesystem>

namespace chainmail {

/// A new private folder. The destructor removes it with its content. Throws Error if it cannot be created.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// From now on, a signal that ends the program (SIGINT, SIGTERM, SIGHUP) removes its temporary folders first. For the
/// main function of a program; a library must leave signals alone.
void remove_folders_on_signals();

}  // namespace chainmail

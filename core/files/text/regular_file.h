#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace chainmail {

/// Throws Error if there is no such file, or if it is a folder, a pipe or a device.
void require_file(const std::filesystem::path& path);

/// A regular file, open for reading. Everything that a user names is opened through this: a pipe could block the
/// program, and a device may never end.
class RegularFile {
 public:
  /// Throws Error without waiting, as require_file does, and if the file may not be read.
  explicit RegularFile(const std::filesystem::path& path);
  RegularFile(RegularFile&& other) noexcept;
  RegularFile& operator=(RegularFile&&) = delete;
  ~RegularFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }
  /// Reads the next bytes and returns their number, which is less than requested only at the end. Throws Error if the
  /// disk fails.
  std::size_t read(std::span<char> bytes);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Returns the path without links and dots, as far as it exists.
std::filesystem::path resolved(const std::filesystem::path& path);

}  // namespace chainmail

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace chainmail {

/// Throws Error if there is no such file, or if it is a folder, a pipe or a device.
void require_file(const std::filesystem::path& path);

/// A regular file, open for reading. All files that the user names are opened with this class: a pipe could block the
/// program, and a device may never end.
class RegularFile {
 public:
  /// Opens the file without waiting. Throws Error if it is not a regular file (see require_file) or may not be read.
  explicit RegularFile(const std::filesystem::path& path);
  RegularFile(RegularFile&& other) noexcept;
  RegularFile& operator=(RegularFile&&) = delete;
  ~RegularFile();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }
  /// Reads the next bytes and returns their number. It is less than the requested one only at the end of the file.
  /// Throws Error if the disk fails.
  std::size_t read(std::span<char> bytes);
  /// Reads bytes from a place in the file in the same way. The next read() does not change.
  std::size_t read_at(std::uint64_t place, std::span<char> bytes) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Returns the path with symbolic links and dots resolved in its existing part.
std::filesystem::path resolved(const std::filesystem::path& path);

}  // namespace chainmail

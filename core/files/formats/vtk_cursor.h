#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

/// Goes through the sections of a legacy VTK file, whose words are text and whose numbers are text or binary.
class VtkCursor {
 public:
  VtkCursor(std::string_view bytes, const std::filesystem::path& path, const Progress& progress)
      : bytes_(bytes), path_(path), progress_(progress) {}

  /// Throws Error at the line where it stands.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  void set_binary(bool binary) { binary_ = binary; }
  /// The rest of the line, and to the next.
  std::string_view line();
  /// The next word, on whatever line; empty at the end.
  std::string_view word();
  /// The next word as a whole number, of `what`.
  std::uint64_t count(const std::string& what);

  /// So many numbers of a type. Their count is checked against the bytes left before memory is taken.
  std::vector<double> reals(std::uint64_t count, std::string_view type);
  /// The same, which must be whole, from 0.
  std::vector<std::uint64_t> wholes(std::uint64_t count, std::string_view type);
  void skip_numbers(std::uint64_t count, std::string_view type);
  /// To behind the next blank line.
  void skip_block();

 private:
  template <class Visit>
  void visit_numbers(std::uint64_t count, std::string_view type, Visit visit);
  template <class Visit>
  void visit_binary(std::uint64_t count, std::string_view type, Visit visit);

  std::string_view bytes_;
  const std::filesystem::path& path_;
  const Progress& progress_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace chainmail

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

/// Reads words and numbers of a legacy VTK file. Words are text; numbers are text or binary.
class VtkCursor {
 public:
  VtkCursor(std::string_view bytes, const std::filesystem::path& path, const Progress& progress)
      : bytes_(bytes), path_(path), progress_(progress) {}

  /// Throws Error at the current line.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  void set_binary(bool binary) { binary_ = binary; }
  /// Size of the file (bytes).
  std::size_t size() const { return bytes_.size(); }
  /// Returns the rest of the line, and moves to the next line.
  std::string_view line();
  /// Returns the next word, on this or a later line; empty at the end.
  std::string_view word();
  /// Returns the next word as a whole number. `what` describes it in error messages.
  std::uint64_t count(const std::string& what);

  /// Returns the next word as a number, also in a binary file.
  double number();
  /// Returns `count` numbers of a type. Before it takes memory, it checks that the file has enough bytes.
  std::vector<double> reals(std::uint64_t count, std::string_view type);
  /// Returns `count` whole numbers from 0.
  std::vector<std::uint64_t> wholes(std::uint64_t count, std::string_view type);
  /// Moves past a field, which may also have strings or bits.
  void skip_field(std::uint64_t count, std::string_view type);
  /// Moves to the line after the next blank line.
  void skip_block();

 private:
  template <class Visit>
  void visit_numbers(std::uint64_t count, std::string_view type, Visit visit);
  template <class Visit>
  void visit_binary(std::uint64_t count, std::string_view type, Visit visit);
  void skip_bytes(std::uint64_t count);
  void skip_string();

  std::string_view bytes_;
  const std::filesystem::path& path_;
  const Progress& progress_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace chainmail

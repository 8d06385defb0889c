#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>

namespace chainmail::api {

/// Writes several files, each of them completely or not at all.
///
/// add() writes the content of each file beside its target. commit() then replaces the targets one after another, so
/// that none is replaced if one cannot be written. The path `-` is standard output, which receives its text in
/// commit().
class Outputs {
 public:
  /// Writes the content of a file.
  using Writer = std::function<void(std::ostream&)>;

  /// Begins without files.
  Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  /// Removes what commit() has not put in place.
  ~Outputs();

  /// Protects an input file: no output may replace it, under this name or another. Call this before add().
  void keep(const std::filesystem::path& input);
  /// Adds a file. Throws Error if it cannot be written or is there twice, and WriteFailure if writing failed.
  void add(const std::filesystem::path& path, Writer writer);
  /// Puts all files in place. Throws Error or WriteFailure; then each target is old or new as a whole.
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes one file. If writing fails, the old file stays. Throws like Outputs.
void write_file(const std::filesystem::path& path, const Outputs::Writer& writer);

/// From now on, a signal that ends the program (SIGINT, SIGTERM, SIGHUP) removes the temporary folders of the library
/// first. For the main function of a program.
void remove_folders_on_signals();

}  // namespace chainmail::api

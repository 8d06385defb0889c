#pragma once

#include <filesystem>

namespace chainmail::import {

/// Starts Gmsh, which has one state for the whole program.
class GmshSession {
 public:
  GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Throws Error, with the message of Gmsh, if it cannot read the file.
  void open(const std::filesystem::path& path) const;
};

/// Returns the first error message of Gmsh since its start, or a general text.
std::string gmsh_complaint();

}  // namespace chainmail::import

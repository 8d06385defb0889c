#pragma once

#include <filesystem>

namespace chainmail::import {

/// Gmsh, which has one state for the whole program, from start to end of this.
class GmshSession {
 public:
  GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Throws Error, in Gmsh's words, where it cannot.
  void open(const std::filesystem::path& path) const;
};

/// The first thing that Gmsh complained of since its start, or a general word.
std::string gmsh_complaint();

}  // namespace chainmail::import

#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "files/mesh/open_mesh.h"
#include "files/text/regular_file.h"

namespace chainmail {

/// The endings of files that are no meshes, with the dot.
inline constexpr std::string_view session_ending = ".chainmail";
inline constexpr std::array<std::string_view, 3> picture_endings{".png", ".jpg", ".jpeg"};

/// What a file is, which decides who reads it.
enum class FileKind { session, picture, mesh, volume };

/// A file that is open to be read. Its readers take it over: no reader opens it a second time.
struct InputFile {
  RegularFile file;
  FileKind kind = FileKind::mesh;
  const MeshFormat* format = nullptr;  // of a mesh or a volume
};

/// Opens a file and decides on its kind; nothing else does. A session is known by its ending, a picture by its ending
/// or its first bytes, a mesh or a volume by its first bytes, else by its ending. Throws Error if the file cannot be
/// read, and if it is of no known kind; the error names archives, web pages and others that people often have instead.
InputFile open_file(const std::filesystem::path& path);

/// Returns the format of a mesh or a volume. Throws Error for other files.
const MeshFormat& format_of(const InputFile& input);

/// Reads an open file as open_mesh(path) does.
OpenedMesh open_mesh(InputFile input, const ReadOptions& options = {}, const Progress& progress = {});

}  // namespace chainmail

#pragma once

#include <array>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "files/formats/imported.h"
#include "files/formats/mesh_state.h"
#include "files/formats/read_options.h"
#include "files/formats/volume.h"
#include "mesh/progress.h"

namespace chainmail {

/// The use of a file: to read an object, to write an object, or to write the current positions of its elements.
enum class FormatUse { read, write, write_positions };

/// A format of meshes or volumes: one row of the table in mesh_formats.cpp. Reading, writing, recognising a file, the
/// file dialogs, the help texts and the sentences of errors all use this table.
struct MeshFormat {
  std::string_view name;
  std::string_view endings;  // in lower case, separated by blanks; files are written with the first
  std::string_view help;     // what a file holds
  /// How a file begins, after blank lines and comments, or with the comment. Unused signs are empty.
  std::array<std::string_view, 5> signs{};
  /// Readers of a mesh or of a volume: a format has one of them, or none if it is only written. They throw Error, with
  /// the line where there is one, and Cancelled.
  ImportedMesh (*read_mesh)(const std::filesystem::path&, const ReadOptions&, const Progress&) = nullptr;
  Volume (*read_volume)(const std::filesystem::path&, const ReadOptions&, const Progress&) = nullptr;
  /// The writer, or none if the format is only read. Throws Error if the format cannot hold the mesh, and Cancelled.
  void (*write)(std::ostream&, const MeshState&, const Progress&) = nullptr;
  /// False if elements have the positions of their lattice.
  bool holds_positions = true;

  bool reads() const { return read_mesh != nullptr || read_volume != nullptr; }
  bool writes() const { return write != nullptr; }
  bool allows(FormatUse use) const {
    return use == FormatUse::read ? reads() : writes() && (holds_positions || use == FormatUse::write);
  }
};

/// Returns all formats, in the order in which they are offered.
std::span<const MeshFormat> mesh_formats();

/// Returns the endings of all formats with a use, as `.dat or .obj`. `last` is the word before the last one.
std::string mesh_endings(FormatUse use, std::string_view last = "or");

/// Returns one line per format with a use, for help texts.
std::string mesh_formats_help(FormatUse use);

/// Returns the format that the ending of a file names, in upper or lower case. Throws Error if no format has this
/// ending, or if it does not have this use.
const MeshFormat& mesh_format(const std::filesystem::path& path, FormatUse use = FormatUse::read);

/// Returns the format of a file that exists: the one whose sign its content begins with, else the one that its ending
/// names. Throws Error if there is no such file, or if neither is known.
const MeshFormat& detect_format(const std::filesystem::path& path);

}  // namespace chainmail

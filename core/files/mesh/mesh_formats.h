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

class RegularFile;

/// The use of a file: to read an object, to write an object, or to write the current positions of its elements.
enum class FormatUse { read, write, write_positions };

/// A format of meshes or volumes: one row of the table in mesh_formats.cpp. Readers, writers, the recognition of files,
/// file dialogs, help texts and error messages all use this table.
struct MeshFormat {
  std::string_view name;
  std::string_view endings;  // in lower case, separated by spaces; the first one is used for writing
  std::string_view help;     // content of such files, for help texts
  /// Texts at the beginning of a file that identify the format, after or within blank lines and comments. Unused
  /// entries are empty.
  std::array<std::string_view, 7> signs{};
  /// The reader of a mesh or of a volume. A format has one of the two, or none if it is only written. They take over
  /// the open file, and throw Error, with the line if the file is text, and Cancelled.
  ImportedMesh (*read_mesh)(RegularFile, const ReadOptions&, const Progress&) = nullptr;
  Volume (*read_volume)(RegularFile, const ReadOptions&, const Progress&) = nullptr;
  /// The writer; null if the format is only read. Throws Error if the format cannot store the mesh, and Cancelled.
  void (*write)(std::ostream&, const MeshState&, const Progress&) = nullptr;
  /// False if the format stores no positions, but only a lattice.
  bool holds_positions = true;
  /// What a file of the format has of an object: all of it, faces and links, or only faces.
  enum class Holds { all, faces_and_links, faces } holds = Holds::all;

  bool reads() const { return read_mesh != nullptr || read_volume != nullptr; }
  bool writes() const { return write != nullptr; }
  bool allows(FormatUse use) const {
    return use == FormatUse::read ? reads() : writes() && (holds_positions || use == FormatUse::write);
  }
};

/// Returns all formats, in the order of menus and help texts.
std::span<const MeshFormat> mesh_formats();

/// Returns the endings of all formats with a use, like `.dat or .obj`. `last` is the word before the last ending.
std::string mesh_endings(FormatUse use, std::string_view last = "or");

/// Returns one line per format with a use, for help texts.
std::string mesh_formats_help(FormatUse use);

/// Throws Error about the path if a file of this format would have nothing of a mesh.
void check_holds(const MeshFormat& format, const Mesh& mesh, const std::filesystem::path& path);
/// Says what a file of this format will not have of a mesh; empty if it has all.
std::string lost_in(const MeshFormat& format, const Mesh& mesh);

/// Returns the format with the ending of a file, in upper or lower case. Throws Error if no format has this ending, or
/// if the format does not have this use.
const MeshFormat& mesh_format(const std::filesystem::path& path, FormatUse use = FormatUse::read);

}  // namespace chainmail

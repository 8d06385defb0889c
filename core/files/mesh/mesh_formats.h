#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace chainmail {

enum class MeshFormat { obj, ply, vtu, off, stl, msh, vtk, medit, tetgen, dat, nrrd, metaimage, csv };

/// What is to be done with a file: an object read from it or written to it, or where its elements stand written.
enum class FormatUse { read, write, write_positions };

/// A format of meshes: the sentences of errors, the file dialogs and the help texts follow from this table.
struct MeshFormatInfo {
  MeshFormat format;
  std::string_view name;
  std::string_view endings;  // parted by blanks, in small letters; the first is the one to write
  bool reads;
  bool writes;
  bool holds_positions;   // else the elements stand in a lattice
  std::string_view help;  // what it holds

  bool allows(FormatUse use) const {
    return use == FormatUse::read ? reads : writes && (holds_positions || use == FormatUse::write);
  }
};

/// Every format, in the order in which they are offered.
std::span<const MeshFormatInfo> mesh_formats();
const MeshFormatInfo& info(MeshFormat format);

/// The endings of the formats of a use in a row: `.dat or .obj`.
std::string mesh_endings(FormatUse use, std::string_view last = "or");

/// The formats of a use with what they hold, a line each, for help texts.
std::string mesh_formats_help(FormatUse use);

/// The format that a file's ending names, in any case of letters. Throws Error for endings of no format, and of one
/// that is not of this use.
MeshFormat mesh_format(const std::filesystem::path& path, FormatUse use = FormatUse::read);

}  // namespace chainmail

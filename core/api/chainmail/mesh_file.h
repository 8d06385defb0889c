#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/job.h"
#include "chainmail/mesh.h"

namespace chainmail::api {

/// A format of files.
struct FileFormat {
  std::string name = {};         ///< Name, like `Wavefront OBJ`.
  std::string endings = {};      ///< Endings in lower case, separated by spaces; the first one is used for writing.
  std::string content = {};      ///< What such files contain.
  bool reads = false;            ///< True if read_mesh() opens it.
  bool writes = false;           ///< True if write_mesh() writes it.
  bool holds_positions = false;  ///< False if it stores links only (.dat).
};

/// Returns all formats.
std::vector<FileFormat> file_formats();

/// Returns where the installed package has chainmail-import, the program that runs the readers of other libraries
/// (.msh, .mesh, .off, .stl, .nrrd) in a sandbox. Programs that find the package with CMake get the path from it; for
/// others it is empty.
inline std::string installed_import_program() {
#ifdef CHAINMAIL_IMPORT_PROGRAM
  return CHAINMAIL_IMPORT_PROGRAM;
#else
  return {};
#endif
}

/// What a file may not say itself.
struct ReadOptions {
  /// Numbers of elements along x, y and z of a .dat file, if neither the file nor its name states them.
  std::optional<std::array<std::uint32_t, 3>> lattice = {};
  std::optional<double> spacing = {};       ///< Distance between the elements of a .dat file (mesh units).
  std::optional<int> space_dimension = {};  ///< Number of coordinates. Default: those along which the mesh extends.
  std::optional<double> threshold = {};     ///< Lowest density of voxels that become elements. Default: Otsu (1979).
  std::optional<std::uint32_t> every = {};  ///< Number of voxels along each axis that become one element.
  bool data_outside = false;                ///< True if a volume's header may name data outside its own folder.
  /// Path of chainmail-import. If there is no such file, it is looked for in the folder of your program, and in ../bin
  /// and ../libexec/chainmail from there. The other formats need no program.
  std::string import_program = installed_import_program();
  bool stiff_where_dense = true;    ///< False: links of dense voxels are not stiffer than others.
  std::optional<double> weld = {};  ///< Points this close become one element (mesh units). Default: by the format.
};

/// Reads a mesh, a volume of voxels, or a pair of TetGen files. The format is recognised by the content, else by the
/// ending. Links of dense voxels are stiffer than others: a Body of the mesh has this softness.
///
/// Libraries that may crash on damaged files run in the separate program chainmail-import, in a sandbox with limited
/// memory and time. Throws Error, with the line if the file is text, if the file does not exist, is damaged or has an
/// unknown format, and if chainmail-import is needed and missing; and Cancelled.
Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options = {}, const Job& job = {});

/// Writes an object with its cuts at its current positions, in the format of the file's ending: faces, cells and links
/// (.obj, .ply, .vtu, .msh, .dat), or a table `id,x,y,z` of positions (.csv). If writing fails, the old file stays.
/// Throws Error if the format is not known or cannot store the object, or if the file cannot be written; and Cancelled.
void write_mesh(const std::filesystem::path& path, const Body& body, const Job& job = {});
/// Writes an object at rest; otherwise the same.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Job& job = {});

}  // namespace chainmail::api

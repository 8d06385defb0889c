#include "files/open_mesh.h"

#include <optional>
#include <utility>

#include "files/dat.h"
#include "files/detect.h"
#include "files/import_process.h"
#include "files/metaimage.h"
#include "files/obj.h"
#include "files/ply.h"
#include "files/temporary_folder.h"
#include "files/tetgen.h"
#include "files/text.h"
#include "files/volume.h"
#include "files/vtk.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// The word by which the import program knows a format: what files of it end in.
std::string task_of(MeshFormat format) {
  std::string_view endings = info(format).endings;
  return std::string(take_word(endings).substr(1));
}

/// By a library, in the import program. Gmsh goes by the name: a file that is called otherwise gets another one.
Imported import(MeshFormat format, const std::filesystem::path& path, const Progress& progress) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) {
    throw Error(shown(path), "this format is read from files alone", "save it as one");
  }
  std::filesystem::path named = path;
  std::optional<TemporaryFolder> folder;
  const std::string task = task_of(format);
  if (path.extension() != "." + task) {
    folder.emplace();
    named = folder->path() / ("mesh." + task);
    std::filesystem::create_symlink(std::filesystem::absolute(path), named);
  }
  try {
    return run_import(task, format == MeshFormat::nrrd ? path : named, {}, limits_for(path), progress);
  } catch (const Error& error) {
    throw error.at(shown(path));
  }
}

bool is_volume(MeshFormat format) { return format == MeshFormat::nrrd || format == MeshFormat::metaimage; }

Volume read_volume(MeshFormat format, const std::filesystem::path& path, const Progress& progress) {
  return format == MeshFormat::metaimage ? read_metaimage(path, progress)
                                         : std::get<Volume>(import(format, path, progress));
}

OpenedMesh open_volume(MeshFormat format, const std::filesystem::path& path, const ReadOptions& options,
                       const Progress& progress) {
  const Volume volume = read_volume(format, path, progress.part(0, 0.5));
  VoxelBlock block = voxel_block(volume, options.voxels, shown(path), progress.part(0.5, 1));
  std::string words = in_words(block);
  return {std::move(block.mesh), std::move(block.softness), {}, std::move(words)};
}

/// Either of the two files was named: the other is beside it.
OpenedMesh open_tetgen(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  const auto beside = [&path](const char* ending) {
    auto other = path;
    other.replace_extension(ending);
    std::error_code none;
    if (!std::filesystem::exists(other, none)) {
      throw Error(shown(path), "its other half, " + shown(other.filename()) + ", is not beside it",
                  "put the pair of .node and .ele into one folder");
    }
    return other;
  };
  const auto nodes = beside(".node"), elements = beside(".ele");
  const std::string points = read_text(nodes, "points"), cells = read_text(elements, "tetrahedra");
  return opened(read_tetgen({points, nodes}, {cells, elements}, progress.part(0, 0.5)), path, options,
                progress.part(0.5, 1));
}

OpenedMesh open_text(MeshFormat format, const std::filesystem::path& path, const ReadOptions& options,
                     const Progress& progress) {
  const std::string text = read_text(path, "a mesh", progress.part(0, 0.05));
  const Progress rest = progress.part(0.05, 1);
  OpenedMesh result;
  result.mesh = format == MeshFormat::dat ? read_dat(text, path, options, rest) : read_obj(text, path, options, rest);
  return result;
}

/// By a reader of ours that takes the whole file.
template <class Read>
OpenedMesh open_bytes(Read read, const std::filesystem::path& path, const ReadOptions& options,
                      const Progress& progress) {
  const std::string bytes = read_bytes(path, "a mesh", progress.part(0, 0.1));
  return opened(read(bytes, path, progress.part(0.1, 0.5)), path, options, progress.part(0.5, 1));
}

OpenedMesh open_as(MeshFormat format, const std::filesystem::path& path, const ReadOptions& options,
                   const Progress& progress) {
  switch (format) {
    case MeshFormat::dat:
    case MeshFormat::obj:
      return open_text(format, path, options, progress);
    case MeshFormat::tetgen:
      return open_tetgen(path, options, progress);
    case MeshFormat::vtk:
      return open_bytes(read_vtk, path, options, progress);
    case MeshFormat::ply:
      return open_bytes(read_ply, path, options, progress);
    case MeshFormat::nrrd:
    case MeshFormat::metaimage:
      return open_volume(format, path, options, progress);
    default:
      break;
  }
  auto imported = import(format, path, progress.part(0, 0.5));
  return opened(std::move(std::get<ImportedMesh>(imported)), path, options, progress.part(0.5, 1));
}

void check_options(MeshFormat format, const std::filesystem::path& path, const ReadOptions& options) {
  if (format != MeshFormat::dat && (options.size || options.spacing)) {
    throw Error(shown(path), "it holds its own positions", "leave size and spacing out");
  }
  if (!is_volume(format) && (options.voxels.threshold || options.voxels.every)) {
    throw Error(shown(path), "it is no volume of voxels", "leave the threshold and the voxels to an element out");
  }
}

}  // namespace

bool is_volume(const std::filesystem::path& path) { return is_volume(detect_format(path)); }

Volume read_volume(const std::filesystem::path& path, const Progress& progress) {
  return read_volume(detect_format(path), path, progress);
}

std::string in_words(const VoxelBlock& block) {
  std::string words = "voxels from a density of ";
  append_number(words, double(float(block.threshold)));
  if (block.every > 1) {
    words += ", " + std::to_string(block.every) + " along each axis to an element";
  }
  return words;
}

OpenedMesh opened(ImportedMesh imported, const std::filesystem::path& path, const ReadOptions& options,
                  const Progress& progress) {
  MeshParts& parts = imported.parts;
  if (parts.rest.empty()) {
    throw Error(shown(path), "it holds no points that anything joins", "give a file with lines, faces or cells");
  }
  OpenedMesh result;
  result.flaws.unused = imported.unused;
  add_links_along_edges(parts);  // of what is left out too
  leave_out_flawed(parts, result.flaws);
  if (parts.links.empty()) {
    throw Error(shown(path), "it holds points and nothing that joins them", "give a file with lines, faces or cells");
  }
  parts.space_dimension = options.space_dimension;
  result.mesh = build_mesh(std::move(parts), progress);
  return result;
}

OpenedMesh open_mesh(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  const MeshFormat format = detect_format(path);
  check_options(format, path, options);
  OpenedMesh result = open_as(format, path, options, progress.part(0, 0.95));
  count_flaws(*result.mesh, result.flaws);
  return result;
}

}  // namespace chainmail

#include "files/mesh/open_mesh.h"

#include <utility>

#include "files/formats/dat.h"
#include "files/formats/data_file.h"
#include "files/formats/metaimage.h"
#include "files/formats/nrrd_head.h"
#include "files/formats/obj.h"
#include "files/formats/ply.h"
#include "files/formats/tetgen.h"
#include "files/formats/volume.h"
#include "files/formats/vtk.h"
#include "files/import/import_process.h"
#include "files/mesh/detect.h"
#include "files/text/regular_file.h"
#include "files/text/text.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// The word by which the import program knows a format: what files of it end in.
std::string task_of(MeshFormat format) {
  std::string_view endings = info(format).endings;
  return std::string(take_word(endings).substr(1));
}

/// By a library, in the import program. Libraries go by the name, so the file gets the ending of its format.
Imported import(MeshFormat format, const std::filesystem::path& path, const Progress& progress) {
  const std::string task = task_of(format);
  const bool by_gmsh = format == MeshFormat::msh || format == MeshFormat::medit;  // and once more for its counts
  ImportInput input(path, by_gmsh ? 2 : 1);
  input.link("mesh." + task, RegularFile(path));
  return run_import(task, input, {}, limits_for(input.linked_size()), progress);
}

/// By teem. Where the data are in a file of their own, teem gets a header that names a link to it.
Volume import_nrrd(const std::filesystem::path& path, bool outside, const Progress& progress) {
  RegularFile file(path);
  std::string beginning(longest_nrrd_head, '\0');
  beginning.resize(file.read(beginning));
  const NrrdHead head = read_nrrd_head(beginning, path);
  ImportInput input(path);
  if (head.data_file.empty()) {
    input.link("volume.nrrd", std::move(file));
  } else {
    input.write("volume.nhdr", head.text);
    input.link("data", RegularFile(data_file(path, head.data_file, outside)));
  }
  return std::get<Volume>(run_import("nrrd", input, {}, limits_for(input.linked_size()), progress));
}

bool is_volume(MeshFormat format) { return format == MeshFormat::nrrd || format == MeshFormat::metaimage; }

Volume read_volume(MeshFormat format, const std::filesystem::path& path, bool outside, const Progress& progress) {
  return format == MeshFormat::metaimage ? read_metaimage(path, outside, progress)
                                         : import_nrrd(path, outside, progress);
}

OpenedMesh open_volume(MeshFormat format, const std::filesystem::path& path, const ReadOptions& options,
                       const Progress& progress) {
  const Volume volume = read_volume(format, path, options.data_outside, progress.part(0, 0.5));
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
  const std::string points = read_text(nodes, "points", progress.part(0, 0.1));
  const std::string cells = read_text(elements, "tetrahedra", progress.part(0.1, 0.2));
  return opened(read_tetgen({points, nodes}, {cells, elements}, progress.part(0.2, 0.5)), path, options,
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
  if (!is_volume(format) && (options.voxels.threshold || options.voxels.every || options.data_outside)) {
    throw Error(shown(path), "it is no volume of voxels", "leave out the options of volumes");
  }
}

}  // namespace

bool is_volume(const std::filesystem::path& path) { return is_volume(detect_format(path)); }

Volume read_volume(const std::filesystem::path& path, const Progress& progress) {
  const bool outside = false;
  return read_volume(detect_format(path), path, outside, progress);
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

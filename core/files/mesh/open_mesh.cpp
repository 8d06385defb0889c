#include "files/mesh/open_mesh.h"

#include <utility>

#include "files/mesh/input_file.h"
#include "files/mesh/join.h"
#include "files/text/text.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

void check_options(const MeshFormat& format, const std::filesystem::path& path, const ReadOptions& options) {
  if (format.holds_positions && (options.size || options.spacing)) {
    throw Error(shown(path), "it contains its own positions", "leave size and spacing out");
  }
  if (format.read_volume == nullptr && (options.voxels.threshold || options.voxels.every || options.data_outside)) {
    throw Error(shown(path), "it is not a volume of voxels", "leave out the options of volumes");
  }
}

/// Returns the distance within which points are one (mesh units); none if they are not joined.
std::optional<double> join_tolerance(const ImportedMesh& imported, const ReadOptions& options) {
  if (options.weld) {
    return options.weld;
  }
  return imported.joins_within > 0 ? std::optional(imported.joins_within * largest_extent(imported.parts))
                                   : std::nullopt;
}

OpenedMesh opened(const Volume& volume, const std::filesystem::path& path, const VoxelOptions& options,
                  const Progress& progress) {
  // Without options, the threshold and the number of voxels per element fit the volume.
  const std::string where = options.threshold ? "threshold" : options.every ? "every" : shown(path);
  VoxelBlock block = voxel_block(volume, options, where, progress);
  std::string words = in_words(block);
  return {std::move(block.mesh), std::move(block.softness), {}, std::move(words)};
}

}  // namespace

OpenedMesh open_mesh(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  return open_mesh(open_file(path), options, progress);
}

OpenedMesh open_mesh(InputFile input, const ReadOptions& options, const Progress& progress) {
  const std::filesystem::path path = input.file.path();
  const MeshFormat& format = format_of(input);
  check_options(format, path, options);
  const Progress reading = progress.part(0, 0.5), building = progress.part(0.5, 0.95);
  OpenedMesh result =
      input.kind == FileKind::volume
          ? opened(format.read_volume(std::move(input.file), options, reading), path, options.voxels, building)
          : opened(format.read_mesh(std::move(input.file), options, reading), path, options, building);
  count_flaws(*result.mesh, result.flaws);
  return result;
}

OpenedMesh opened(ImportedMesh imported, const std::filesystem::path& path, const ReadOptions& options,
                  const Progress& progress) {
  MeshParts& parts = imported.parts;
  if (parts.rest.empty()) {
    throw Error(shown(path), "it contains no linked points", "use a file with lines, faces or cells");
  }
  OpenedMesh result;
  result.flaws.unused = imported.unused;
  result.flaws.collapsed = imported.collapsed;
  result.flaws.divided = imported.divided;
  result.flaws.skipped = imported.skipped;
  if (const auto tolerance = join_tolerance(imported, options)) {
    result.flaws.joined = join_close(parts, *tolerance);
  }
  add_links_along_edges(parts);  // includes faces and cells that are left out
  if (!imported.checked) {
    leave_out_flawed(parts, result.flaws);
  }
  if (parts.links.empty() && !imported.checked && !imported.may_lack_links) {
    throw Error(shown(path), "it contains points without links", "use a file with lines, faces or cells");
  }
  parts.space_dimension = chosen_space(parts, options.space_dimension, imported.space, path);
  result.mesh = build_mesh(std::move(parts), progress);
  return result;
}

std::string in_words(const VoxelBlock& block) {
  std::string words = "voxels from a density of ";
  append_number(words, double(float(block.threshold)));
  if (block.every > 1) {
    words += ", " + std::to_string(block.every) + " along each axis to an element";
  }
  return words;
}

}  // namespace chainmail

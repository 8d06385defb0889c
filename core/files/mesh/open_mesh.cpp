#include "files/mesh/open_mesh.h"

#include <utility>

#include "files/mesh/join.h"
#include "files/mesh/mesh_formats.h"
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

OpenedMesh open_volume(const MeshFormat& format, const std::filesystem::path& path, const ReadOptions& options,
                       const Progress& progress) {
  const Volume volume = format.read_volume(path, options, progress.part(0, 0.5));
  // Without options, the threshold and the number of voxels per element fit the volume.
  const std::string where = options.voxels.threshold ? "threshold" : options.voxels.every ? "every" : shown(path);
  VoxelBlock block = voxel_block(volume, options.voxels, where, progress.part(0.5, 1));
  std::string words = in_words(block);
  return {std::move(block.mesh), std::move(block.softness), {}, std::move(words)};
}

}  // namespace

OpenedMesh open_mesh(const std::filesystem::path& path, const ReadOptions& options, const Progress& progress) {
  const MeshFormat& format = detect_format(path);
  check_options(format, path, options);
  OpenedMesh result = format.read_volume != nullptr ? open_volume(format, path, options, progress.part(0, 0.95))
                                                    : opened(format.read_mesh(path, options, progress.part(0, 0.5)),
                                                             path, options, progress.part(0.5, 0.95));
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

bool is_volume(const std::filesystem::path& path) { return detect_format(path).read_volume != nullptr; }

Volume read_volume(const std::filesystem::path& path, const Progress& progress) {
  const MeshFormat& format = detect_format(path);
  if (format.read_volume == nullptr) {
    throw Error(shown(path), "it is not a volume of voxels", "open a volume");
  }
  return format.read_volume(path, {}, progress);
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

#include <teem/nrrd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "files/formats/nrrd_head.h"
#include "files/import/program/tasks.h"
#include "files/text/limits.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::import {
namespace {

struct Remove {
  void operator()(Nrrd* nrrd) const { nrrdNuke(nrrd); }
};

constexpr std::size_t longest = 150;

/// Returns the last line of teem's messages, which is the cause. The lines before it say where the error occurred.
std::string complaint() {
  const std::unique_ptr<char, decltype(&std::free)> text(biffGetDone(NRRD), &std::free);
  const std::string all = text ? text.get() : "";
  const std::size_t last = all.find_last_not_of(" \r\n");
  if (last == std::string::npos) {
    return "it does not say why";
  }
  const std::size_t first = all.rfind('\n', last) + 1;
  return printable(all.substr(first, std::min(longest, last + 1 - first)));
}

/// Returns the distance between voxels along an axis: the spacing that the file states, else the length of the axis
/// direction in space, else 1.
double spacing_of(const NrrdAxisInfo& axis, unsigned dimension) {
  double squares = 0;
  for (unsigned k = 0; k < dimension; ++k) {
    squares += axis.spaceDirection[k] * axis.spaceDirection[k];
  }
  for (const double spacing : {std::abs(axis.spacing), std::sqrt(squares)}) {
    if (std::isfinite(spacing) && spacing > 0) {
      return spacing;
    }
  }
  return 1;
}

using AxisPointers = std::vector<const NrrdAxisInfo*>;

/// Returns the axes of the voxels. More than three are a volume if the others have one channel, or one time: of those,
/// the first without a direction in space is left out.
AxisPointers voxel_axes(const Nrrd& file) {
  AxisPointers axes;
  for (unsigned k = 0; k < file.dim; ++k) {
    axes.push_back(&file.axis[k]);
  }
  while (axes.size() > 3) {
    auto found = std::ranges::find_if(
        axes, [](const NrrdAxisInfo* axis) { return axis->size == 1 && std::isnan(axis->spaceDirection[0]); });
    found = found != axes.end() ? found : std::ranges::find(axes, std::size_t{1}, &NrrdAxisInfo::size);
    if (found == axes.end()) {
      break;
    }
    axes.erase(found);
  }
  return axes;
}

/// Returns the directions of the axes in space; those of space for a file that states none.
Eigen::Matrix3d directions_of(const Nrrd& file) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const AxisPointers of_voxels = voxel_axes(file);
  for (std::size_t k = 0; file.spaceDim == 3 && k < 3; ++k) {
    const double* const along = of_voxels[k]->spaceDirection;
    const Point direction(along[0], along[1], along[2]);
    if (direction.allFinite() && !direction.isZero()) {
      axes.col(Eigen::Index(k)) = direction.stableNormalized();
    }
  }
  if (!are_axes(axes)) {
    refuse("its space directions lie in one plane", "export it again");
  }
  return axes;
}

/// Loads a file, or its header only, without memory for the data.
std::unique_ptr<Nrrd, Remove> load(const std::filesystem::path& path, bool header_only) {
  const std::unique_ptr<NrrdIoState, decltype(&nrrdIoStateNix)> how(nrrdIoStateNew(), &nrrdIoStateNix);
  how->skipData = header_only ? 1 : 0;
  std::unique_ptr<Nrrd, Remove> file(nrrdNew());
  if (nrrdLoad(file.get(), path.c_str(), how.get()) != 0) {
    refuse("teem cannot read it (" + complaint() + ")", "export it again");
  }
  return file;
}

std::uint64_t size_of(const std::filesystem::path& path) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  return none ? 0 : size;
}

/// Returns the number of voxels along each axis. Refuses more than the data of this size can give.
std::array<std::uint32_t, 3> checked_size(const Nrrd& file, std::uint64_t data_bytes) {
  const AxisPointers axes = voxel_axes(file);
  if (axes.size() != 3 || file.type == nrrdTypeBlock) {
    refuse("it has " + std::to_string(axes.size()) + " axes, but a volume of densities has 3",
           "save a single channel at a single time");
  }
  const auto size = checked_volume_size("", {axes[0]->size, axes[1]->size, axes[2]->size});
  const std::uint64_t voxels = std::uint64_t{size[0]} * size[1] * size[2];
  if (voxels * nrrdTypeSize[file.type] / limits::compression_ratio > data_bytes) {
    refuse("its data are too few for its voxels, or compressed too much", "export it again, as raw data");
  }
  return size;
}

}  // namespace

Volume read_nrrd(const std::filesystem::path& path) {
  std::uint64_t data_bytes = size_of(path);
  for (std::size_t i = 0; i < limits::nrrd_files; ++i) {
    data_bytes += size_of(path.parent_path() / nrrd_data_name(i));
  }
  checked_size(*load(path, true), data_bytes);
  const auto file = load(path, false);
  Volume volume;
  volume.size = checked_size(*file, data_bytes);
  const AxisPointers axes = voxel_axes(*file);
  for (std::size_t k = 0; k < 3; ++k) {
    volume.spacing[Eigen::Index(k)] = spacing_of(*axes[k], file->spaceDim);
    const double origin = file->spaceDim == 3 ? file->spaceOrigin[k] : axes[k]->min;
    volume.origin[Eigen::Index(k)] = std::isfinite(origin) ? origin : 0;
  }
  volume.axes = directions_of(*file);
  const auto number = nrrdDLookup[file->type];
  take_densities(volume, "", [&](std::size_t i) { return number(file->data, i); });
  return volume;
}

}  // namespace chainmail::import

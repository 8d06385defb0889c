#include "files/formats/voxel_block.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "files/text/text.h"
#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr ElementId no_voxel = std::numeric_limits<ElementId>::max();
using Size = std::array<std::uint32_t, 3>;

/// Boxes of voxels with their mean densities.
class Bricks {
 public:
  Bricks(const Volume& volume, std::uint32_t edge, const Progress& progress)
      : volume_(&volume), boxes_(volume.size, edge) {
    if (edge > 1) {
      take_means(progress);
    } else {
      for (std::size_t step = 0; step < single_.size(); ++step) {
        single_[step] = float(volume.lowest + volume.step * double(step));
      }
    }
  }

  const VoxelBoxes& boxes() const { return boxes_; }
  std::size_t place(std::size_t x, std::size_t y, std::size_t z) const {
    return x + boxes_.count[0] * (y + boxes_.count[1] * z);
  }
  /// Density of a brick. Bricks of one voxel take no memory of their own.
  float density(std::size_t brick) const { return means_.empty() ? single_[volume_->densities[brick]] : means_[brick]; }
  std::uint64_t count_above(double threshold) const {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < boxes_.total(); ++i) {
      count += double(density(i)) >= threshold ? 1 : 0;
    }
    return count;
  }

 private:
  void take_means(const Progress& progress) {
    means_.reserve(boxes_.total());
    const auto number = [&](std::size_t voxel) {
      progress.report(voxel, volume_->voxel_count());
      return volume_->densities[voxel];
    };
    for_each_box<float>(boxes_, number, [this](float sum, std::uint64_t voxels) {
      means_.push_back(float(volume_->lowest + volume_->step * double(sum) / double(voxels)));
    });
  }

  const Volume* volume_;
  VoxelBoxes boxes_;
  std::vector<float> means_;
  std::vector<float> single_ = std::vector<float>(std::size_t(max_density_steps) + 1);  // density of each step
};

/// The axes of voxels as those of space: axis k of space is axis `from[k]` of the voxels, and may run the other way.
struct SpaceAxes {
  std::array<std::size_t, 3> from{0, 1, 2};
  std::array<bool, 3> reversed{};
};

/// Returns how the axes of the voxels lie along those of space; none if they are oblique.
std::optional<SpaceAxes> along_space(const Eigen::Matrix3d& axes) {
  SpaceAxes result;
  for (Eigen::Index k = 0; k < 3; ++k) {
    Eigen::Index column = 0;
    const double length = axes.row(k).cwiseAbs().maxCoeff(&column);
    if (std::abs(length - 1) > 1e-9 || std::abs(axes.row(k).cwiseAbs().sum() - 1) > 1e-9) {
      return std::nullopt;
    }
    result.from[std::size_t(k)] = std::size_t(column);
    result.reversed[std::size_t(k)] = axes(k, column) < 0;
  }
  return result;
}

/// Returns the texel of each density.
std::vector<std::uint8_t> shades_of(const Volume& volume) {
  const auto [lowest, highest] = std::minmax_element(volume.densities.begin(), volume.densities.end());
  const double range = std::max(int{*highest} - int{*lowest}, 1);
  std::vector<std::uint8_t> shades(std::size_t{*highest} + 1);
  for (std::size_t density = *lowest; density < shades.size(); ++density) {
    shades[density] = static_cast<std::uint8_t>(std::lround(255 * double(density - *lowest) / range));
  }
  return shades;
}

/// Returns the densities as a texture, whose axes are those of space; none for oblique voxels.
std::shared_ptr<const Texture> texture_of(const Volume& volume) {
  const auto axes = along_space(volume.axes);
  if (!axes) {
    return nullptr;
  }
  const std::vector<std::uint8_t> shades = shades_of(volume);
  auto texture = std::make_shared<Texture>();
  texture->channels = 1;
  std::array<std::size_t, 3> step{};  // in densities, from one texel to the next along each axis
  std::size_t first = 0;
  const std::array<std::size_t, 3> steps{1, volume.size[0], std::size_t{volume.size[0]} * volume.size[1]};
  const Point low = volume.at(Point::Constant(-0.5)),
              high = volume.at(Point(volume.size[0], volume.size[1], volume.size[2]) - Point::Constant(0.5));
  for (std::size_t k = 0; k < 3; ++k) {
    texture->size[k] = volume.size[axes->from[k]];
    step[k] = steps[axes->from[k]];
    first += axes->reversed[k] ? (texture->size[k] - 1) * step[k] : 0;
  }
  texture->box = {low.cwiseMin(high), low.cwiseMax(high)};
  texture->texels.reserve(volume.densities.size());
  const auto along = [&](std::size_t k, std::size_t i) { return axes->reversed[k] ? 0 - i * step[k] : i * step[k]; };
  for (std::size_t z = 0; z < texture->size[2]; ++z) {
    for (std::size_t y = 0; y < texture->size[1]; ++y) {
      for (std::size_t x = 0; x < texture->size[0]; ++x) {
        texture->texels.push_back(shades[volume.densities[first + along(0, x) + along(1, y) + along(2, z)]]);
      }
    }
  }
  return texture;
}

/// Builds the elements of bricks that reach a density, numbered along x, then y, then z, with their links and cells.
class BlockBuilder {
 public:
  BlockBuilder(const Volume& volume, const Bricks& bricks, double threshold)
      : volume_(volume),
        bricks_(bricks),
        threshold_(threshold),
        size_(bricks.boxes().count),
        is_mirrored_(volume.axes.determinant() < 0) {
    number_layer(0);
  }

  /// Appends the density of each element to `densities`.
  MeshParts build(std::vector<float>& densities, const Progress& progress) {
    for (std::uint32_t z = 0; z < size_[2]; ++z) {
      number_layer(z + 1);
      progress.report(double(z) / size_[2]);
      for (std::uint32_t y = 0; y < size_[1]; ++y) {
        for (std::uint32_t x = 0; x < size_[0]; ++x) {
          if (at(x, y, z) != no_voxel) {
            add(x, y, z);
            densities.push_back(bricks_.density(bricks_.place(x, y, z)));
          }
        }
      }
    }
    return std::move(parts_);
  }

 private:
  /// Numbers the elements of a layer. Two layers are kept.
  void number_layer(std::uint32_t z) {
    auto& layer = element_[z % 2];
    layer.assign(std::size_t{size_[0]} * size_[1], no_voxel);
    for (std::size_t i = 0; z < size_[2] && i < layer.size(); ++i) {
      if (double(bricks_.density(bricks_.place(0, 0, z) + i)) >= threshold_) {
        layer[i] = next_++;
      }
    }
  }
  ElementId at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return x < size_[0] && y < size_[1] && z < size_[2] ? element_[z % 2][x + std::size_t{size_[0]} * y] : no_voxel;
  }

  void add(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const auto& edges = bricks_.boxes().edges;
    const Point edge(edges[0], edges[1], edges[2]);
    parts_.rest.push_back(volume_.at(Point(x, y, z).cwiseProduct(edge) + (edge - Point::Ones()) / 2));
    const ElementId here = at(x, y, z);
    for (const ElementId other : {at(x + 1, y, z), at(x, y + 1, z), at(x, y, z + 1)}) {
      if (other != no_voxel) {
        parts_.links.push_back({here, other});
      }
    }
    std::array<ElementId, 8> cell{here,
                                  at(x + 1, y, z),
                                  at(x + 1, y + 1, z),
                                  at(x, y + 1, z),
                                  at(x, y, z + 1),
                                  at(x + 1, y, z + 1),
                                  at(x + 1, y + 1, z + 1),
                                  at(x, y + 1, z + 1)};
    if (is_mirrored_) {
      std::rotate(cell.begin(), cell.begin() + 4, cell.end());  // so that its volume is positive
    }
    if (std::find(cell.begin(), cell.end(), no_voxel) == cell.end()) {
      parts_.hexahedra.push_back(cell);
    }
  }

  const Volume& volume_;
  const Bricks& bricks_;
  double threshold_;
  Size size_;
  bool is_mirrored_;
  std::array<std::vector<ElementId>, 2> element_;  // element of each brick of an even and of an odd layer
  ElementId next_ = 0;
  MeshParts parts_;
};

/// Returns the softness of links: default if both ends have the threshold's density, rigid if both have the highest
/// density.
OwnSoftness softness_by_density(const Mesh& mesh, const std::vector<float>& densities, double threshold) {
  constexpr double levels = 32;  // number of different values of softness
  const LinkSoftness defaults;
  const double range = double(*std::max_element(densities.begin(), densities.end())) - threshold;
  OwnSoftness softness;
  for (LinkId link = 0; range > 0 && link < mesh.link_count(); ++link) {
    const auto& [a, b] = mesh.links[link];
    const double mean = (double(densities[a]) + double(densities[b])) / 2;
    const double share = std::round(std::clamp((mean - threshold) / range, 0.0, 1.0) * levels) / levels;
    if (share > 0) {
      softness.set(link, {defaults.compression + share * (1 - defaults.compression),
                          defaults.stretch - share * (defaults.stretch - 1), defaults.shear * (1 - share)});
    }
  }
  return softness;
}

/// Returns the edge at which `count` dense bricks of `now` become at most `most`, if they lie close together.
std::uint32_t estimated_edge(const VoxelBoxes& now, std::uint64_t count, double most) {
  const double share = std::min(1.0, most / double(count));
  return boxes_for(now.volume, std::max(std::uint64_t(share * double(now.total())), std::uint64_t{1})).edge();
}

/// Returns bricks that do not give too many elements. Each try allows half as many as the one before, so that the
/// number of tries does not depend on the volume.
Bricks chosen_bricks(const Volume& volume, const VoxelOptions& options, double threshold, const Progress& progress) {
  if (options.every) {
    return {volume, (*options.every - 1) / volume.merged + 1, progress};
  }
  Bricks bricks(volume, 1, progress);
  double most = voxel_elements;
  for (std::uint64_t count; (count = bricks.count_above(threshold)) > voxel_elements; most /= 2) {
    const std::uint32_t edge = estimated_edge(bricks.boxes(), count, most);
    bricks = Bricks(volume, std::max(edge, bricks.boxes().edge() + 1), progress);
  }
  return bricks;
}

}  // namespace

double otsu_threshold(const Volume& volume) {
  constexpr std::size_t bins = 65536;
  std::vector<std::uint32_t> counts(bins);
  for (const std::uint16_t density : volume.densities) {
    ++counts[density];
  }
  const std::vector<double> histogram(counts.begin(), counts.end());
  const auto count = double(volume.densities.size());
  double sum = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    sum += double(i) * histogram[i];
  }
  double below = 0, sum_below = 0, best = -1;
  std::size_t first = 0, last = 0;  // range of thresholds with the same classes: no density lies between them
  for (std::size_t i = 0; i + 1 < bins; ++i) {
    below += histogram[i];
    sum_below += double(i) * histogram[i];
    if (below == 0 || below == count) {
      continue;
    }
    const double apart = sum_below / below - (sum - sum_below) / (count - below);
    const double between = below * (count - below) * apart * apart;
    if (between > best) {
      best = between;
      first = last = i;
    } else if (histogram[i] == 0 && last + 1 == i) {
      last = i;
    }
  }
  return volume.lowest + volume.step * (double(first + last) / 2 + 0.5);
}

VoxelBlock voxel_block(const Volume& volume, const VoxelOptions& options, const std::string& where,
                       const Progress& progress) {
  VoxelBlock block;
  block.threshold = options.threshold.value_or(otsu_threshold(volume));
  const Bricks bricks = chosen_bricks(volume, options, block.threshold, progress.part(0, 0.3));
  const std::uint64_t count = bricks.count_above(block.threshold);
  block.every = bricks.boxes().edge() * volume.merged;
  std::string threshold;
  append_number(threshold, block.threshold);
  if (count == 0) {
    throw Error(where, "no voxel has a density of " + threshold + " or more", "choose a lower density");
  }
  if (count > element_limit) {
    throw Error(where, std::to_string(count) + " voxels have a density of " + threshold + " or more",
                "use several voxels per element");
  }
  std::vector<float> densities;
  MeshParts parts = BlockBuilder(volume, bricks, block.threshold).build(densities, progress.part(0.3, 0.6));
  parts.texture = texture_of(volume);
  block.mesh = build_mesh(std::move(parts), progress.part(0.7, 1));
  if (options.stiff_where_dense) {
    block.softness = softness_by_density(*block.mesh, densities, block.threshold);
  }
  return block;
}

}  // namespace chainmail

#include "files/formats/voxel_block.h"

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
constexpr std::uint64_t most_texels = std::uint64_t{1} << 27;  // at most 128 MiB on the graphics card

using Size = std::array<std::uint32_t, 3>;

/// Blocks of `every` voxels along each axis, with their mean densities.
struct Bricks {
  Size size{1, 1, 1};
  std::vector<float> densities;

  std::size_t place(std::size_t x, std::size_t y, std::size_t z) const { return x + size[0] * (y + size[1] * z); }
};

Bricks averaged(const Volume& volume, std::uint32_t every, const Progress& progress) {
  Bricks bricks;
  std::transform(volume.size.begin(), volume.size.end(), bricks.size.begin(),
                 [every](std::uint32_t n) { return (n - 1) / every + 1; });
  std::vector<std::uint32_t> counts(std::size_t{bricks.size[0]} * bricks.size[1] * bricks.size[2]);
  bricks.densities.resize(counts.size());
  std::size_t voxel = 0;
  for (std::uint32_t z = 0; z < volume.size[2]; ++z) {
    progress.report(double(z) / volume.size[2]);
    for (std::uint32_t y = 0; y < volume.size[1]; ++y) {
      for (std::uint32_t x = 0; x < volume.size[0]; ++x, ++voxel) {
        const std::size_t brick = bricks.place(x / every, y / every, z / every);
        bricks.densities[brick] += float(volume.densities[voxel]);
        ++counts[brick];
      }
    }
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    bricks.densities[i] = float(volume.lowest + volume.step * double(bricks.densities[i]) / counts[i]);
  }
  return bricks;
}

std::uint64_t count_above(const Bricks& bricks, double threshold) {
  return std::uint64_t(std::count_if(bricks.densities.begin(), bricks.densities.end(),
                                     [threshold](float density) { return double(density) >= threshold; }));
}

std::shared_ptr<const Texture> texture_of(const Volume& volume, const Progress& progress) {
  std::uint32_t every = 1;
  while (volume.voxel_count() / every / every / every > most_texels) {
    ++every;
  }
  const Bricks bricks = averaged(volume, every, progress);
  auto texture = std::make_shared<Texture>();
  texture->size = bricks.size;
  texture->channels = 1;
  const auto lowest = std::min_element(bricks.densities.begin(), bricks.densities.end());
  const auto highest = std::max_element(bricks.densities.begin(), bricks.densities.end());
  const float range = std::max(*highest - *lowest, std::numeric_limits<float>::min());
  texture->texels.resize(bricks.densities.size());
  std::transform(bricks.densities.begin(), bricks.densities.end(), texture->texels.begin(), [&](float density) {
    return static_cast<std::uint8_t>(std::lround(255 * (density - *lowest) / range));
  });
  texture->box[0] = volume.origin - volume.spacing / 2;
  for (int k = 0; k < 3; ++k) {
    texture->box[1][k] = texture->box[0][k] + volume.spacing[k] * every * bricks.size[k];
  }
  return texture;
}

/// Builds the elements of bricks that reach a density, numbered along x, then y, then z, with their links and cells.
class BlockBuilder {
 public:
  BlockBuilder(const Volume& volume, const Bricks& bricks, std::uint32_t every, double threshold)
      : volume_(volume), bricks_(bricks), every_(every), element_(bricks.densities.size(), no_voxel) {
    ElementId next = 0;
    for (std::size_t i = 0; i < element_.size(); ++i) {
      element_[i] = double(bricks.densities[i]) >= threshold ? next++ : no_voxel;
    }
  }

  /// Appends the density of each element to `densities`.
  MeshParts build(std::vector<float>& densities, const Progress& progress) {
    const auto& size = bricks_.size;
    for (std::uint32_t z = 0; z < size[2]; ++z) {
      progress.report(double(z) / size[2]);
      for (std::uint32_t y = 0; y < size[1]; ++y) {
        for (std::uint32_t x = 0; x < size[0]; ++x) {
          if (at(x, y, z) != no_voxel) {
            add(x, y, z);
            densities.push_back(bricks_.densities[bricks_.place(x, y, z)]);
          }
        }
      }
    }
    return std::move(parts_);
  }

 private:
  ElementId at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const auto& size = bricks_.size;
    return x < size[0] && y < size[1] && z < size[2] ? element_[bricks_.place(x, y, z)] : no_voxel;
  }

  void add(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const Point steps = Point(x, y, z) * every_ + Point::Constant((every_ - 1) / 2.0);
    parts_.rest.push_back(volume_.origin + volume_.spacing.cwiseProduct(steps));
    const ElementId here = at(x, y, z);
    for (const ElementId other : {at(x + 1, y, z), at(x, y + 1, z), at(x, y, z + 1)}) {
      if (other != no_voxel) {
        parts_.links.push_back({here, other});
      }
    }
    const std::array<ElementId, 8> cell{here,
                                        at(x + 1, y, z),
                                        at(x + 1, y + 1, z),
                                        at(x, y + 1, z),
                                        at(x, y, z + 1),
                                        at(x + 1, y, z + 1),
                                        at(x + 1, y + 1, z + 1),
                                        at(x, y + 1, z + 1)};
    if (std::find(cell.begin(), cell.end(), no_voxel) == cell.end()) {
      parts_.hexahedra.push_back(cell);
    }
  }

  const Volume& volume_;
  const Bricks& bricks_;
  std::uint32_t every_;
  std::vector<ElementId> element_;  // element of each brick
  MeshParts parts_;
};

/// Returns the softness of links: default if both ends have the threshold's density, rigid if both have the highest
/// density.
OwnSoftness softness_by_density(const Mesh& mesh, const std::vector<float>& densities, double threshold) {
  constexpr double levels = 32;  // number of different values of softness
  const LinkSoftness standard;
  const double range = double(*std::max_element(densities.begin(), densities.end())) - threshold;
  OwnSoftness softness;
  for (LinkId link = 0; range > 0 && link < mesh.link_count(); ++link) {
    const auto& [a, b] = mesh.links[link];
    const double mean = (double(densities[a]) + double(densities[b])) / 2;
    const double share = std::round(std::clamp((mean - threshold) / range, 0.0, 1.0) * levels) / levels;
    if (share > 0) {
      softness.set(link, {standard.compression + share * (1 - standard.compression),
                          standard.stretch - share * (standard.stretch - 1), standard.shear * (1 - share)});
    }
  }
  return softness;
}

/// Returns the smallest bricks that do not give too many elements.
Bricks chosen_bricks(const Volume& volume, const VoxelOptions& options, double threshold, std::uint32_t& every,
                     const Progress& progress) {
  every = options.every.value_or(1);
  Bricks bricks = averaged(volume, every, progress);
  while (!options.every && count_above(bricks, threshold) > voxel_elements) {
    bricks = averaged(volume, ++every, progress);
  }
  return bricks;
}

}  // namespace

double otsu_threshold(const Volume& volume) {
  constexpr std::size_t bins = 65536;
  std::vector<double> histogram(bins);
  double count = 0, sum = 0;
  for (const std::uint16_t density : volume.densities) {
    ++histogram[density];
    ++count;
    sum += density;
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
  const Bricks bricks = chosen_bricks(volume, options, block.threshold, block.every, progress.part(0, 0.3));
  const std::uint64_t count = count_above(bricks, block.threshold);
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
  MeshParts parts =
      BlockBuilder(volume, bricks, block.every, block.threshold).build(densities, progress.part(0.3, 0.6));
  parts.texture = texture_of(volume, progress.part(0.6, 0.7));
  block.mesh = build_mesh(std::move(parts), progress.part(0.7, 1));
  if (options.stiff_where_dense) {
    block.softness = softness_by_density(*block.mesh, densities, block.threshold);
  }
  return block;
}

}  // namespace chainmail

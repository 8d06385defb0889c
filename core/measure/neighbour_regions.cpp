#include "measure/neighbour_regions.h"

#include <algorithm>
#include <array>

#include "measure/violation.h"
#include "solve/region.h"

namespace chainmail {
namespace {

template <int Dimension>
NeighbourRegion region_of(const Mesh& mesh, const LinkSoftness& softness, const PositionView& position, ElementId about,
                          ElementId neighbour) {
  const auto region = valid_region<double, Dimension>(mesh, about, neighbour, softness);
  std::array<double, Dimension> low{}, high{}, at{}, nearest{};
  for (int k = 0; k < Dimension; ++k) {
    low[k] = position(about, k) + region.low[k];
    high[k] = position(about, k) + region.high[k];
    at[k] = position(neighbour, k);
    nearest[k] = std::clamp(at[k], low[k], high[k]);
  }
  return {neighbour,
          0,
          mesh.to_point(low.data()),
          mesh.to_point(high.data()),
          mesh.to_point(at.data()),
          mesh.to_point(nearest.data())};
}

}  // namespace

std::vector<NeighbourRegion> neighbour_regions(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                               const PositionView& position, ElementId about, std::size_t at_most) {
  const auto of_dimension = mesh.space_dimension == 1   ? region_of<1>
                            : mesh.space_dimension == 2 ? region_of<2>
                                                        : region_of<3>;
  std::vector<NeighbourRegion> regions;
  for_each_neighbour(mesh, cuts, about, [&](ElementId neighbour, EntryId entry) {
    if (regions.size() < at_most) {
      const LinkId link = mesh.entry_link[entry];
      regions.push_back(of_dimension(mesh, softness.of(link), position, about, neighbour));
      regions.back().link = link;
      regions.back().inside = link_violation(mesh, softness, position, link) <= counts_as_violated;
    }
  });
  return regions;
}

}  // namespace chainmail

#include "measure/neighbour_regions.h"

#include <algorithm>

#include "body/region.h"
#include "measure/violation.h"

namespace chainmail {
namespace {

template <int Dimension>
NeighbourRegion region_of(const Mesh& mesh, const RegionAxes& axes, const LinkSoftness& softness,
                          const PositionView& position, ElementId about, ElementId neighbour) {
  const auto region = valid_region<double, Dimension>(mesh, axes, about, neighbour, softness);
  const Point sponsor = axes.into_axes(point_of(mesh, position, about));
  const Point at = point_of(mesh, position, neighbour);
  Point low = sponsor, high = sponsor, nearest = axes.into_axes(at);
  for (int k = 0; k < Dimension; ++k) {
    const int axis = mesh.axes[std::size_t(k)];
    low[axis] += region.low[k];
    high[axis] += region.high[k];
    nearest[axis] = std::clamp(nearest[axis], low[axis], high[axis]);
  }
  return {neighbour, 0, low, high, axes, at, axes.into_world(nearest)};
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
      regions.push_back(of_dimension(mesh, softness.axes, softness.of(link), position, about, neighbour));
      regions.back().link = link;
      regions.back().inside = link_violation(mesh, softness, position, link) <= counts_as_violated;
    }
  });
  return regions;
}

}  // namespace chainmail

#include "mesh/outer_surface.h"

#include <algorithm>
#include <limits>

#include "mesh/error.h"
#include "mesh/surface.h"

namespace chainmail {

ElementId OuterSurface::on_surface(ElementId of_volume) const {
  const auto found = std::ranges::lower_bound(elements, of_volume);
  return found != elements.end() && *found == of_volume ? static_cast<ElementId>(found - elements.begin())
                                                        : std::numeric_limits<ElementId>::max();
}

OuterSurface outer_surface(const MeshPointer& volume) {
  const std::vector<ElementId> corners = Surface(std::make_shared<const CellTable>(volume)).triangles();
  if (corners.empty()) {
    throw Error("surface", "the object has no cells, so it has no outer surface", "use a volume");
  }
  OuterSurface surface{nullptr, corners};
  std::ranges::sort(surface.elements);
  surface.elements.erase(std::unique(surface.elements.begin(), surface.elements.end()), surface.elements.end());
  MeshParts parts;
  for (const ElementId element : surface.elements) {
    parts.rest.push_back(volume->rest_position(element));
  }
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const ElementId a = surface.on_surface(corners[i]), b = surface.on_surface(corners[i + 1]),
                    c = surface.on_surface(corners[i + 2]);
    parts.triangles.push_back({a, b, c});
    parts.links.insert(parts.links.end(), {{a, b}, {b, c}, {c, a}});
  }
  parts.space_dimension = volume->space_dimension;
  surface.mesh = build_mesh(std::move(parts));
  return surface;
}

}  // namespace chainmail

#include "files/formats/space.h"

#include <algorithm>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {

int extent_dimension(const Mesh& mesh, const PositionView& positions) {
  int dimension = 0;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    ElementId element = 1;
    while (element < mesh.element_count() && positions(element, k) == positions(0, k)) {
      ++element;
    }
    dimension += element < mesh.element_count() ? 1 : 0;
  }
  return std::max(dimension, 1);
}

std::string space_comment(const Mesh& mesh, const PositionView& positions) {
  if (mesh.space_dimension == extent_dimension(mesh, positions)) {
    return {};
  }
  return "# space " + std::to_string(mesh.space_dimension) + "\n";
}

std::optional<int> chosen_space(const MeshParts& parts, std::optional<int> asked,
                                const std::optional<Stated<int>>& stated, const std::filesystem::path& path) {
  if (asked || !stated) {
    return asked;
  }
  int needed = 0;
  for (int k = 0; k < 3; ++k) {
    needed += std::any_of(parts.rest.begin(), parts.rest.end(),
                          [&](const Point& p) { return p[k] != parts.rest.front()[k]; });
  }
  if (stated->value < needed) {
    throw Error(shown(path, stated->line), "the mesh extends along " + std::to_string(needed) + " axes",
                "use a space dimension of " + std::to_string(needed) + " or more");
  }
  return stated->value;
}

}  // namespace chainmail

#include "measure/element_cells.h"

namespace chainmail {
namespace {

// The corners of a hexahedron, each with its three neighbours, counterclockwise as seen from outside the corner.
constexpr std::array<std::array<std::size_t, 4>, 8> corners_of_hexahedron{
    {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};

}  // namespace

std::vector<Simplex> simplices_of(const Mesh& mesh) {
  std::vector<Simplex> result;
  std::size_t cell = 0;
  for (const auto& corners : mesh.tetrahedra) {
    result.push_back({corners, 4, cell++});
  }
  for (const auto& corners : mesh.hexahedra) {
    for (const auto& [a, b, c, d] : corners_of_hexahedron) {
      result.push_back({{corners[a], corners[b], corners[c], corners[d]}, 4, cell});
    }
    ++cell;
  }
  if (result.empty()) {
    for (const auto& [a, b, c] : mesh.triangles) {
      result.push_back({{a, b, c, a}, 3, cell++});
    }
  }
  return result;
}

}  // namespace chainmail

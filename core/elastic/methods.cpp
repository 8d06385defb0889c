#include "elastic/methods.h"

#include "elastic/closed_surface.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::uint64_t boundary_limit = 2'800;  // triangles; takes 28 s and 560 MB

[[noreturn]] void refuse_size(const std::string& where, std::uint64_t has, std::uint64_t most, const char* what) {
  throw Error(where,
              "it is limited to " + std::to_string(most) + " " + what + ", and this object has " + std::to_string(has),
              "use a coarser mesh");
}

}  // namespace

void check_fem(const std::string& where, const Mesh& mesh, const SizeLimits& limits) {
  const bool is_full_grid = mesh.is_grid && mesh.object_dimension == mesh.space_dimension;
  const bool has_cells = mesh.has_cells() || is_full_grid;
  if (mesh.space_dimension == 3 && !has_cells) {
    throw Error(where, "the object has no tetrahedra or hexahedra, so it is not a solid",
                "fill its surface: 'chainmail fill', or Object > Fill with tetrahedra");
  }
  if (mesh.space_dimension == 2 && mesh.triangles.empty() && !is_full_grid) {
    throw Error(where, "the object has no triangles, so it is not a sheet", "use a mesh with faces");
  }
  const std::uint64_t most = limits[static_cast<std::size_t>(mesh.space_dimension)];
  if (mesh.element_count() > most) {
    refuse_size(where, mesh.element_count(), most, "elements");
  }
}

void check_cells(const std::string& where, const Mesh& mesh) {
  const bool is_full_grid = mesh.is_grid && mesh.object_dimension == mesh.space_dimension;
  if (mesh.space_dimension > 1 && !is_full_grid && mesh.triangles.empty() && mesh.tetrahedra.empty() &&
      mesh.hexahedra.empty()) {
    throw Error(where, "the object has no faces or cells", "use a mesh with faces, or fill its surface");
  }
  const std::uint64_t most = edge_limit[static_cast<std::size_t>(mesh.space_dimension)];
  if (mesh.element_count() > most) {
    refuse_size(where, mesh.element_count(), most, "elements");
  }
}

void check_boundary(const Mesh& mesh) {
  if (mesh.space_dimension != 3 || (mesh.triangles.empty() && !mesh.has_cells())) {
    throw Error("BEM", "it works only on closed surfaces of triangles in space, and this object has none",
                "open a surface or a volume, or compare by linear FEM");
  }
  // The number of triangles around a volume is known only after its faces were found.
  check_boundary_size(mesh.has_cells() ? 0 : mesh.triangles.size(), mesh.has_cells() ? mesh.element_count() : 0);
  if (!mesh.has_cells()) {
    check_closed(mesh);
  }
}

void check_boundary_size(std::uint64_t triangles, std::uint64_t elements_of_cells) {
  if (triangles > boundary_limit) {
    refuse_size("BEM", triangles, boundary_limit, "triangles on the surface");
  }
  if (elements_of_cells > boundary_inner_limit) {
    refuse_size("BEM", elements_of_cells, boundary_inner_limit, "elements, if they are volumes");
  }
}

}  // namespace chainmail

#include "elastic/elastic.h"

#include <array>

#include "elastic/methods.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// By object dimension: what a factorization takes in seconds and in memory of a desktop, measured.
constexpr std::array<std::uint64_t, 4> linear_limit{0, 1'000'000, 150'000, 30'000};
constexpr std::array<std::uint64_t, 4> neo_hookean_limit{0, 100'000, 20'000, 6'000};
constexpr std::uint64_t boundary_limit = 2'800;        // triangles: 28 s and 560 MB
constexpr std::uint64_t boundary_inner_limit = 5'000;  // elements of volumes: 3 s more for each that is taken hold of

[[noreturn]] void refuse_size(const std::string& where, std::uint64_t has, std::uint64_t most, const char* what) {
  throw Error(
      where,
      "it takes objects of up to " + std::to_string(most) + " " + what + ", and this one has " + std::to_string(has),
      "use a coarser mesh");
}

void check_fem(const std::string& where, const Mesh& mesh, const std::array<std::uint64_t, 4>& limits) {
  const bool is_full_grid = mesh.is_grid && mesh.object_dimension == mesh.space_dimension;
  const bool has_cells = !mesh.tetrahedra.empty() || !mesh.hexahedra.empty() || is_full_grid;
  if (mesh.space_dimension == 3 && !has_cells) {
    throw Error(where, "the object has no tetrahedra or hexahedra, so it is no solid",
                "fill its surface: 'chainmail fill', or Object > Fill with tetrahedra");
  }
  if (mesh.space_dimension == 2 && mesh.triangles.empty() && !is_full_grid) {
    throw Error(where, "the object has no triangles, so it is no sheet", "use a mesh with faces");
  }
  const std::uint64_t most = limits[static_cast<std::size_t>(mesh.space_dimension)];
  if (mesh.element_count() > most) {
    refuse_size(where, mesh.element_count(), most, "elements");
  }
}

void check_boundary(const Mesh& mesh) {
  const bool has_cells = !mesh.tetrahedra.empty() || !mesh.hexahedra.empty();
  if (mesh.space_dimension != 3 || (mesh.triangles.empty() && !has_cells)) {
    throw Error("BEM", "it works on closed surfaces of triangles in space, and this object has none",
                "open a surface or a volume, or compare by linear FEM");
  }
  // How many triangles are about a volume is known when its sides have been looked at.
  check_boundary_size(has_cells ? 0 : mesh.triangles.size(), has_cells ? mesh.element_count() : 0);
}

}  // namespace

void check_boundary_size(std::uint64_t triangles, std::uint64_t elements_of_cells) {
  if (triangles > boundary_limit) {
    refuse_size("BEM", triangles, boundary_limit, "triangles on their surface");
  }
  if (elements_of_cells > boundary_inner_limit) {
    refuse_size("BEM", elements_of_cells, boundary_inner_limit, "elements, if they are volumes");
  }
}

void check(ElasticMethod method, const Mesh& mesh) {
  switch (method) {
    case ElasticMethod::linear_fem:
      return check_fem("linear FEM", mesh, linear_limit);
    case ElasticMethod::neo_hookean:
      return check_fem("neo-Hookean FEM", mesh, neo_hookean_limit);
    case ElasticMethod::boundary:
      return check_boundary(mesh);
    case ElasticMethod::free_form:
      return;
  }
}

bool fits(ElasticMethod method, const Mesh& mesh) {
  try {
    check(method, mesh);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::unique_ptr<ElasticSolver> make_elastic(ElasticMethod method, const ElasticProblem& problem,
                                            const Progress& progress) {
  check(problem.options);
  check(method, *problem.mesh);
  switch (method) {
    case ElasticMethod::linear_fem:
      return make_linear_fem(problem, progress);
    case ElasticMethod::neo_hookean:
      return make_neo_hookean(problem, progress);
    case ElasticMethod::boundary:
      return make_boundary_elements(problem, progress);
    default:
      return make_free_form(problem, progress);
  }
}

}  // namespace chainmail

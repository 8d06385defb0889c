#include "elastic/elastic.h"

#include <algorithm>
#include <array>
#include <string>

#include "elastic/methods.h"
#include "elastic/shells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Largest number of elements by space dimension, for acceptable time and memory of a factorization (measured).
constexpr std::array<std::uint64_t, 4> linear_limit{0, 1'000'000, 150'000, 30'000};
constexpr std::array<std::uint64_t, 4> nonlinear_limit{0, 100'000, 20'000, 6'000};
constexpr std::array<std::uint64_t, 4> edge_limit{0, 1'000'000, 150'000, 100'000};
constexpr std::uint64_t boundary_limit = 2'800;        // triangles; takes 28 s and 560 MB
constexpr std::uint64_t boundary_inner_limit = 5'000;  // elements of volumes; takes 3 s more for each new handle

[[noreturn]] void refuse_size(const std::string& where, std::uint64_t has, std::uint64_t most, const char* what) {
  throw Error(where,
              "it is limited to " + std::to_string(most) + " " + what + ", and this object has " + std::to_string(has),
              "use a coarser mesh");
}

void check_fem(const std::string& where, const Mesh& mesh, const std::array<std::uint64_t, 4>& limits) {
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

/// The methods that work on the edges of cells or faces, of surfaces in space as well.
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

/// One method: its check of an object, the largest number of elements of a solid that this accepts (0: any), and its
/// maker. To add a method, add a constant to ElasticMethod and an entry here.
struct MethodEntry {
  ElasticMethod method;
  std::uint64_t most_in_solids;
  void (*check)(const Mesh& mesh);
  std::unique_ptr<ElasticSolver> (*make)(const ElasticProblem& problem, const Progress& progress);
};
constexpr std::array methods{
    MethodEntry{ElasticMethod::linear_fem, linear_limit[3],
                [](const Mesh& mesh) { check_fem("linear FEM", mesh, linear_limit); }, make_linear_fem},
    MethodEntry{ElasticMethod::neo_hookean, nonlinear_limit[3],
                [](const Mesh& mesh) { check_fem("neo-Hookean FEM", mesh, nonlinear_limit); }, make_neo_hookean},
    MethodEntry{ElasticMethod::boundary, boundary_inner_limit, check_boundary, make_boundary_elements},
    MethodEntry{ElasticMethod::free_form, 0, [](const Mesh&) {}, make_free_form},
    MethodEntry{ElasticMethod::corotational, nonlinear_limit[3],
                [](const Mesh& mesh) { check_fem("corotational FEM", mesh, nonlinear_limit); }, make_corotational},
    MethodEntry{ElasticMethod::arap, edge_limit[3], [](const Mesh& mesh) { check_cells("ARAP", mesh); }, make_arap},
    MethodEntry{ElasticMethod::xpbd, edge_limit[3], [](const Mesh& mesh) { check_cells("XPBD", mesh); }, make_xpbd},
    MethodEntry{ElasticMethod::projective, edge_limit[3],
                [](const Mesh& mesh) { check_cells("Projective Dynamics", mesh); }, make_projective},
    MethodEntry{ElasticMethod::quasi_newton, linear_limit[3],
                [](const Mesh& mesh) { check_fem("quasi-Newton FEM", mesh, linear_limit); }, make_quasi_newton},
    MethodEntry{ElasticMethod::neo_hookean_xpbd, edge_limit[3],
                [](const Mesh& mesh) { check_fem("neo-Hookean XPBD", mesh, edge_limit); }, make_neo_hookean_xpbd},
};

const MethodEntry& entry_of(ElasticMethod method) { return *std::ranges::find(methods, method, &MethodEntry::method); }

}  // namespace

ElasticMotion ElasticMotion::by(std::span<const double> translation) {
  const auto n = static_cast<Eigen::Index>(translation.size());
  return {SmallMatrix::Zero(n, n), Eigen::Map<const Eigen::VectorXd>(translation.data(), n)};
}

SmallVector displacement_of(const ElasticHandle& handle, std::size_t i, const ElasticMotion& motion) {
  if (handle.elements.size() == 1) {
    return motion.translation;
  }
  const Eigen::Index n = motion.translation.size();
  const auto of = [&](const std::vector<double>& all) {
    return Eigen::Map<const Eigen::VectorXd>(all.data() + static_cast<Eigen::Index>(i) * n, n);
  };
  const SmallVector turned = motion.turn * of(handle.arms);
  return of(handle.displacements) + turned + motion.translation;
}

void check_boundary_size(std::uint64_t triangles, std::uint64_t elements_of_cells) {
  if (triangles > boundary_limit) {
    refuse_size("BEM", triangles, boundary_limit, "triangles on the surface");
  }
  if (elements_of_cells > boundary_inner_limit) {
    refuse_size("BEM", elements_of_cells, boundary_inner_limit, "elements, if they are volumes");
  }
}

std::optional<std::uint64_t> max_solid_elements(ElasticMethod method) {
  const std::uint64_t most = entry_of(method).most_in_solids;
  return most > 0 ? std::optional(most) : std::nullopt;
}

void check(ElasticMethod method, const Mesh& mesh) { entry_of(method).check(mesh); }

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
  return entry_of(method).make(problem, progress);
}

}  // namespace chainmail

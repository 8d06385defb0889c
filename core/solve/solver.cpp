#include "solve/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "mesh/error.h"
#include "solve/original.h"
#include "solve/typed_solver.h"

namespace chainmail {
namespace {

constexpr std::array infos{
    AlgorithmInfo{Algorithm::generalized, "generalized", "Generalized ChainMail",
                  "Li and Brodlie 2003; Dean 2004, 3.1"},
    AlgorithmInfo{Algorithm::spiral, "spiral", "Spiral", "Dean 2004, 3.2"},
    AlgorithmInfo{Algorithm::natural_queue, "natural-queue", "Natural Queue ChainMail", "Dean 2004, 4.1"},
    AlgorithmInfo{Algorithm::enhanced, "enhanced", "Enhanced ChainMail", "Schill et al. 1998"},
    AlgorithmInfo{Algorithm::original, "original", "3D ChainMail", "Frisken-Gibson 1997; Dean 2004, 2.1"},
    AlgorithmInfo{Algorithm::exact, "exact", "Exact ChainMail", "this project"},
    AlgorithmInfo{Algorithm::linear_fem, "fem", "Linear FEM", "Bro-Nielsen and Cotin 1996"},
    AlgorithmInfo{Algorithm::neo_hookean, "neo-hookean", "Neo-Hookean FEM", "Bonet and Wood 1997"},
    AlgorithmInfo{Algorithm::boundary_elements, "bem", "BEM", "James and Pai 1999"},
    AlgorithmInfo{Algorithm::free_form, "ffd", "Free-form deformation", "Sederberg and Parry 1986; Hsu et al. 1992"},
};
constexpr std::size_t family = 6;  // the first of them are the ChainMail family

template <class Scalar>
std::unique_ptr<Solver> make_typed(const MeshPointer& mesh, Algorithm algorithm) {
  switch (mesh->space_dimension) {
    case 1:
      return std::make_unique<TypedSolver<Scalar, 1>>(mesh, algorithm);
    case 2:
      return std::make_unique<TypedSolver<Scalar, 2>>(mesh, algorithm);
    default:
      return std::make_unique<TypedSolver<Scalar, 3>>(mesh, algorithm);
  }
}

}  // namespace

std::span<const AlgorithmInfo> algorithms() { return std::span(infos).first(family); }
std::span<const AlgorithmInfo> elastic_algorithms() { return std::span(infos).subspan(family); }
std::span<const AlgorithmInfo> every_algorithm() { return infos; }

std::optional<ElasticMethod> elastic_method(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::linear_fem:
      return ElasticMethod::linear_fem;
    case Algorithm::neo_hookean:
      return ElasticMethod::neo_hookean;
    case Algorithm::boundary_elements:
      return ElasticMethod::boundary;
    case Algorithm::free_form:
      return ElasticMethod::free_form;
    default:
      return std::nullopt;
  }
}

const AlgorithmInfo& info(Algorithm algorithm) {
  return *std::find_if(infos.begin(), infos.end(), [&](auto& entry) { return entry.algorithm == algorithm; });
}

std::optional<Algorithm> find_algorithm(std::string_view name) {
  const auto found = std::find_if(infos.begin(), infos.end(), [&](auto& entry) { return entry.name == name; });
  return found == infos.end() ? std::nullopt : std::optional(found->algorithm);
}

bool fits(Algorithm algorithm, const Mesh& mesh) {
  const auto method = elastic_method(algorithm);
  return method ? fits(*method, mesh) : algorithm != Algorithm::original || mesh.is_grid;
}

void check(Algorithm algorithm, const Mesh& mesh) {
  if (const auto method = elastic_method(algorithm)) {
    check(*method, mesh);
  } else if (!fits(algorithm, mesh)) {
    throw Error("3D ChainMail", "it works on grids alone, with links along the axes, and this mesh is none",
                "choose another algorithm, or generate a grid or a block");
  }
}

double position_limit(Precision precision) {
  return precision == Precision::single_precision ? double(std::numeric_limits<float>::max() / 16)
                                                  : std::numeric_limits<double>::max() / 16;
}

void check(const Placement& placement, const Mesh& mesh, Precision precision) {
  const auto& runs = placement.runs;
  std::uint64_t given = 0;
  bool ascending = runs.size() % 2 == 0;
  for (std::size_t i = 0; ascending && i < runs.size(); i += 2) {
    ascending = runs[i] < runs[i + 1] && runs[i + 1] <= mesh.element_count() && (i == 0 || runs[i - 1] <= runs[i]);
    given += runs[i + 1] - runs[i];
  }
  if (!ascending) {
    throw Error("placement", "its runs are not ascending runs of elements",
                "give the first of each run, and the one behind its last");
  }
  const auto dimension = static_cast<std::uint64_t>(mesh.space_dimension);
  if (placement.held.size() != dimension * given) {
    throw Error("placement",
                "it holds " + std::to_string(placement.held.size()) + " coordinates, and its runs name " +
                    std::to_string(given) + " elements in " + std::to_string(dimension) + "D",
                "give each coordinate of each of them");
  }
  const double limit = position_limit(precision);
  if (!std::ranges::all_of(placement.held, [limit](double held) { return std::abs(held) <= limit; })) {
    throw Error("placement", "it holds a number beyond what the precision does", "keep coordinates within 1e37");
  }
}

Point point_of(const Mesh& mesh, const PositionView& positions, ElementId element) {
  std::array<double, 3> carried{};
  for (int k = 0; k < mesh.space_dimension; ++k) {
    carried[k] = positions(element, k);
  }
  return mesh.to_point(carried.data());
}

std::unique_ptr<Solver> make_solver(const MeshPointer& mesh, Algorithm algorithm, Precision precision) {
  check(algorithm, *mesh);
  return precision == Precision::single_precision ? make_typed<float>(mesh, algorithm)
                                                  : make_typed<double>(mesh, algorithm);
}

}  // namespace chainmail

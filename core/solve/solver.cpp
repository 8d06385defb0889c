#include "solve/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "mesh/error.h"
#include "solve/typed_solver.h"

namespace chainmail {
namespace {

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

double position_limit(Precision precision) {
  return precision == Precision::single_precision ? double(std::numeric_limits<float>::max() / 16)
                                                  : std::numeric_limits<double>::max() / 16;
}

void check(const Snapshot& snapshot, const Mesh& mesh, Precision precision) {
  const auto& runs = snapshot.runs;
  std::uint64_t given = 0;
  bool ascending = runs.size() % 2 == 0;
  for (std::size_t i = 0; ascending && i < runs.size(); i += 2) {
    ascending = runs[i] < runs[i + 1] && runs[i + 1] <= mesh.element_count() && (i == 0 || runs[i - 1] <= runs[i]);
    given += runs[i + 1] - runs[i];
  }
  if (!ascending) {
    throw Error("positions", "the runs of elements are not ascending pairs",
                "give the first element of each run and the one after its last, in ascending order");
  }
  const auto dimension = static_cast<std::uint64_t>(mesh.space_dimension);
  if (snapshot.held.size() != dimension * given) {
    throw Error("positions",
                "there are " + std::to_string(snapshot.held.size()) + " coordinates, but the runs contain " +
                    std::to_string(given) + " elements in " + std::to_string(dimension) + "D",
                "give all coordinates of each element");
  }
  const double limit = position_limit(precision);
  if (!std::ranges::all_of(snapshot.held, [limit](double held) { return std::abs(held) <= limit; })) {
    throw Error("positions", "a coordinate is out of the range of the precision", "keep coordinates within 1e37");
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

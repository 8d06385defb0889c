#include "solve/snapshot.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/error.h"

namespace chainmail {

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

}  // namespace chainmail

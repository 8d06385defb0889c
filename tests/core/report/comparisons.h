#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/families.h"
#include "report/run/compare.h"

namespace chainmail::report::test {

using chainmail::test::jittered_triangles;

/// A drag of one element in this number of steps.
inline RecordedMoves drag(const Mesh& mesh, ElementId element, const Point& by, int steps = 4) {
  RecordedMoves moves{"drag", "", {commands::Grab{element}}};
  for (int i = 1; i <= steps; ++i) {
    moves.commands.emplace_back(commands::Drag{mesh.rest_position(element) + by * i / steps});
  }
  return moves;
}

inline Case object(const MeshPointer& mesh, RecordedMoves moves) {
  return {"object", "", mesh, {}, {}, {}, {std::move(moves)}};
}

inline Case jittered() {
  const auto mesh = jittered_triangles(8, 8, 1);
  return object(mesh, drag(*mesh, 27, {4, 2, 0}));
}

inline CompareOptions quick(std::vector<Algorithm> algorithms = {}, std::vector<int> sweeps = {0},
                            Precision precision = Precision::double_precision) {
  CompareOptions options;
  options.algorithms = std::move(algorithms);
  options.sweeps = std::move(sweeps);
  options.precision = precision;
  options.repetitions = 2;
  return options;
}

/// Returns the row of the only contestant in the only drag.
inline Row row_of(const Case& one, Algorithm algorithm, int sweeps = 0) {
  return compare({one}, quick({algorithm}, {sweeps})).rows.at(0);
}

/// Returns the row of a contestant in a drag of an object.
inline const Row& row_of(const Results& results, std::size_t object, std::optional<std::size_t> drag,
                         const Contestant& contestant) {
  const auto found = std::ranges::find_if(results.rows, [&](const Row& row) {
    return row.object == object && row.drag == drag && row.contestant == contestant;
  });
  return found == results.rows.end() ? throw std::out_of_range(label(contestant)) : *found;
}

/// Returns the figures that are the same on every machine: all but times and memory.
inline std::vector<std::pair<const Figure*, Value>> same_everywhere(const Row& row) {
  auto kept = row.figures;
  std::erase_if(kept, [](const auto& one) { return one.first->unit == "ms" || one.first == &figures::bytes; });
  return kept;
}

/// Clocks that advance by the same time with each reading.
class DrivenClocks {
 public:
  explicit DrivenClocks(double seconds) : seconds_(seconds) {}
  Clocks clocks() {
    const auto tick = [this] { return now_ += seconds_; };
    return {tick, tick};
  }

 private:
  double seconds_, now_ = 0;
};

// For positions below 10 and paths of about ten links, in double.
constexpr double rounding = 1e-13;

}  // namespace chainmail::report::test

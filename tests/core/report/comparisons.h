#pragma once

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

inline CompareOptions quick(std::vector<Algorithm> algorithms = {}, std::vector<int> sweeps = {0},
                            Precision precision = Precision::double_precision) {
  CompareOptions options;
  options.algorithms = std::move(algorithms);
  options.sweeps = std::move(sweeps);
  options.precision = precision;
  options.repetitions = 2;
  return options;
}

inline DragResult compare_one(const Case& one, const CompareOptions& options) {
  return compare({one}, options).cases.at(0).drags.at(0);
}

inline Errors errors_of(const Case& one, Algorithm algorithm, int sweeps = 0) {
  return compare_one(one, quick({algorithm}, {sweeps})).entries.at(0).measurement.value().errors;
}

inline Case jittered() {
  const auto mesh = jittered_triangles(8, 8, 1);
  return object(mesh, drag(*mesh, 27, {4, 2, 0}));
}

// For positions below 10 and paths of about ten links, in double.
constexpr double rounding = 1e-13;

}  // namespace chainmail::report::test

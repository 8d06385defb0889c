#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/run/drag_reference.h"
#include "report/run/suite_experiments.h"
#include "report/table/results.h"

namespace chainmail::report {

/// A drag of one object as another solver needs it, with its reference. Points have three coordinates (mesh units).
struct PeerCase {
  std::string name, description;
  MeshPointer mesh;  // of tetrahedra, or of triangles in a plane
  std::vector<ElementId> pins, handle;
  std::vector<std::vector<Point>> moves;  // where each move puts the handle's elements, in their order
  ElasticOptions elastic;
  std::vector<Point> reference;            // positions of all elements after the last move
  std::optional<double> reference_change;  // of the reference, by its last refinement (ratio)
};

/// What another solver found.
struct PeerAnswer {
  std::string solver, case_name;
  std::vector<Point> positions;  // of all elements after the last move
  std::optional<double> factorize_ms, grab_ms;
  std::vector<double> moves_ms;  // of each move, without preparation; empty if they were not timed
};

/// Makes a case of a drag without a cut.
PeerCase peer_case(const Case& object, const RecordedMoves& drag, const DragReference& reference);
/// Makes cases of the drags in which the suite measures the time to an error, without those that only take part where
/// they are named. `organs` as for the suite: drags of an organ without a file are left out.
std::vector<PeerCase> peer_cases_of_suite(const SampleOrgans& organs);

/// Measures answers as the suite measures its contestants: a row for each solver. Throws Error if one is of another
/// case or size, has times for another number of moves, or if a pin or an element of the handle is not where the last
/// move puts it, and if the error is not a number.
Results judge(const PeerCase& object, const std::vector<PeerAnswer>& answers);

}  // namespace chainmail::report

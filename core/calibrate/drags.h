#pragma once

#include <vector>

#include "calibrate/calibrate.h"
#include "measure/reference_solution.h"
#include "report/run/cases.h"

namespace chainmail {

/// A drag and its reference solution.
struct ReferenceDrag {
  ElementId element = 0;
  Point target = Point::Zero();
  ReferenceSolution reference;
  report::RecordedMoves moves;
};

/// Drags for the search, and drags for testing the result.
struct ReferenceDrags {
  std::vector<ReferenceDrag> fitted, held_out;
};

/// Returns random drags of an object, the same for the same seed. Drags whose reference does not converge are replaced.
/// Drags for testing use other elements than those for the search, if there are enough.
ReferenceDrags reference_drags(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                               const Progress& progress);

}  // namespace chainmail

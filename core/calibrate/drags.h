#pragma once

#include <vector>

#include "calibrate/calibrate.h"
#include "measure/reference_solution.h"
#include "report/run/cases.h"

namespace chainmail {

/// A drag, and where it should lead.
struct ReferenceDrag {
  ElementId element = 0;
  Point target = Point::Zero();
  ReferenceSolution reference;
  report::RecordedMoves moves;
};

/// Drags to come close to, and drags to test the result on.
struct ReferenceDrags {
  std::vector<ReferenceDrag> fitted, held_out;
};

/// Random drags of an object, the same for the same seed. Those whose reference does not converge are drawn anew. Drags
/// that are held out take elements that no fitted drag takes, where there are enough.
ReferenceDrags reference_drags(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                               const Progress& progress);

}  // namespace chainmail

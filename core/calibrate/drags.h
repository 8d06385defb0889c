#pragma once

#include <vector>

#include "calibrate/calibrate.h"
#include "measure/truth.h"
#include "report/cases.h"

namespace chainmail {

/// A drag, and where it should have led.
struct TrueDrag {
  ElementId element = 0;
  Point target = Point::Zero();
  Truth truth;
  report::RecordedMoves moves;
};

/// Random drags of an object, the same for the same seed. Those whose truth does not converge are drawn anew.
std::vector<TrueDrag> true_drags(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                                 const Progress& progress);

}  // namespace chainmail

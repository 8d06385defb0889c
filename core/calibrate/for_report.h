#pragma once

#include "report/run/physics_contestant.h"

namespace chainmail {

/// Returns the calibration for comparisons with physics. It uses fewer drags and evaluations than the default of
/// `calibrate`. Their number is fixed, so results are the same on every machine.
report::Calibrator calibrator_for_reports(RelaxationScheme scheme);

}  // namespace chainmail

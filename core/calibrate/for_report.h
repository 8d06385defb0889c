#pragma once

#include "report/run/physics_contestant.h"

namespace chainmail {

/// Calibrates contestants of a comparison with physics, with fewer drags and tries than `calibrate` makes by default:
/// its time is bounded by their number, so that figures are the same on every machine.
report::Calibrator calibrator_for_reports(RelaxationScheme scheme);

}  // namespace chainmail

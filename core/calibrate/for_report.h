#pragma once

#include "calibrate/calibrate.h"
#include "report/run/physics.h"

namespace chainmail {

/// Returns the calibration for comparisons with physics. It uses fewer drags and evaluations than the default of
/// `calibrate`. Their number is fixed, so results are the same on every machine.
report::Calibrator calibrator_for_reports(RelaxationScheme scheme);

/// Returns a calibration as a report: the errors on the drags of the search (`fitted`) and on the others (`held out`)
/// of an object that does not move, of the default softness, and of the one that was found.
report::Results results_of(const std::string& name, const Mesh& mesh, const CalibrationOptions& options,
                           const CalibrationResult& found);

}  // namespace chainmail

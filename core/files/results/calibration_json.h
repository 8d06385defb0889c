#pragma once

#include <ostream>

#include "calibrate/calibrate.h"

namespace chainmail {

/// What was looked for, what was found, and the error that stays, drag by drag.
void write_json(std::ostream& out, const CalibrationOptions& options, const CalibrationResult& result);

}  // namespace chainmail

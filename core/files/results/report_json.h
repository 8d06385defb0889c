#pragma once

#include <ostream>

#include "calibrate/calibrate.h"
#include "report/run/compare.h"
#include "report/run/machine.h"
#include "report/run/physics.h"
#include "report/run/ramp.h"

namespace chainmail {

// Each function writes all figures of one kind of report as JSON. A figure that does not exist is null.

void write_json(std::ostream& out, const report::Comparison& comparison, const report::Origin& origin);
void write_json(std::ostream& out, const report::PhysicsReport& report, const report::Origin& origin);
void write_json(std::ostream& out, const report::Ramp& ramp, const report::Machine& machine);
void write_json(std::ostream& out, const CalibrationOptions& options, const CalibrationResult& result);

}  // namespace chainmail

#pragma once

#include <ostream>

#include "report/run/machine.h"
#include "report/run/ramp.h"

namespace chainmail {

/// A ramp with all its figures; null where there is none.
void write_json(std::ostream& out, const report::Ramp& ramp, const report::Machine& machine);

}  // namespace chainmail

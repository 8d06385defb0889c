#pragma once

#include <ostream>

#include "report/machine.h"
#include "report/ramp.h"

namespace chainmail {

/// A ramp with all its figures; null where there is none.
void write_json(std::ostream& out, const report::Ramp& ramp, const report::Machine& machine);

}  // namespace chainmail

#pragma once

#include <ostream>

#include "report/run/machine.h"
#include "report/run/ramp.h"

namespace chainmail::report {

/// Writes the results of each algorithm, then the times size by size, as text.
void write_text(std::ostream& out, const Ramp& ramp, const Machine& machine);

/// Writes one row for each algorithm and size under a header, with all digits.
void write_csv(std::ostream& out, const Ramp& ramp);

}  // namespace chainmail::report

#pragma once

#include <ostream>

#include "report/run/machine.h"
#include "report/run/ramp.h"

namespace chainmail::report {

/// For people: what came out for each algorithm, then the times size by size.
void write_text(std::ostream& out, const Ramp& ramp, const Machine& machine);

/// A row an algorithm and size, under a header; numbers with all their digits.
void write_csv(std::ostream& out, const Ramp& ramp);

}  // namespace chainmail::report

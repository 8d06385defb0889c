#pragma once

#include <ostream>

#include "report/run/physics.h"

namespace chainmail::report {

/// Writes a header, then a row for each contestant, drag and object. Numbers have all digits.
void write_csv(std::ostream& out, const PhysicsReport& report);

}  // namespace chainmail::report

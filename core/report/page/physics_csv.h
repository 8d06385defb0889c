#pragma once

#include <ostream>

#include "report/run/physics.h"

namespace chainmail::report {

/// Writes a row for each contestant, drag and object, with all digits.
void write_csv(std::ostream& out, const PhysicsReport& report);

}  // namespace chainmail::report

#pragma once

#include <ostream>

#include "report/run/machine.h"
#include "report/run/physics.h"

namespace chainmail::report {

/// Writes the report as one self-contained HTML page.
void write_html(std::ostream& out, const PhysicsReport& report, const Origin& origin);

}  // namespace chainmail::report

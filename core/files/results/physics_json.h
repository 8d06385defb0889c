#pragma once

#include <ostream>

#include "report/run/machine.h"
#include "report/run/physics.h"

namespace chainmail {

/// A comparison with physics with all its figures; null where there is none.
void write_json(std::ostream& out, const report::PhysicsReport& report, const report::Origin& origin);

}  // namespace chainmail

#pragma once

#include <ostream>

#include "report/run/compare.h"
#include "report/run/machine.h"

namespace chainmail {

/// A comparison with all its figures; null where there is none.
void write_json(std::ostream& out, const report::Comparison& comparison, const report::Origin& origin);

}  // namespace chainmail

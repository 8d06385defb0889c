#pragma once

#include <ostream>

#include "report/run/compare.h"
#include "report/run/machine.h"

namespace chainmail::report {

/// A comparison as one page that needs nothing else: tables, plots, how to read them, where they come from.
void write_html(std::ostream& out, const Comparison& comparison, const Origin& origin);

}  // namespace chainmail::report

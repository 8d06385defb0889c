#pragma once

#include <ostream>

#include "report/compare.h"
#include "report/machine.h"

namespace chainmail::report {

/// A comparison as one page that needs nothing else: tables, plots, how to read them, where they come from.
void write_html(std::ostream& out, const Comparison& comparison, const Origin& origin);

}  // namespace chainmail::report

#pragma once

#include <ostream>

#include "report/run/compare.h"
#include "report/run/machine.h"

namespace chainmail::report {

/// Writes a comparison as one self-contained HTML page: explanations, tables, plots, and their origin.
void write_html(std::ostream& out, const Comparison& comparison, const Origin& origin);

}  // namespace chainmail::report

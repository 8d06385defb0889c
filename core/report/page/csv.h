#pragma once

#include <ostream>

#include "report/run/compare.h"

namespace chainmail::report {

/// Writes a header, then a row for each contestant, drag and object. Numbers have all digits; missing values are empty
/// fields.
void write_csv(std::ostream& out, const Comparison& comparison);

}  // namespace chainmail::report

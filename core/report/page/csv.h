#pragma once

#include <ostream>

#include "report/run/compare.h"

namespace chainmail::report {

/// Writes a row for each contestant, drag and object, under a header. Numbers have all digits; a field is empty where
/// there is no figure.
void write_csv(std::ostream& out, const Comparison& comparison);

}  // namespace chainmail::report

#pragma once

#include <ostream>

#include "report/run/suite.h"

namespace chainmail::report {

/// Writes a header, then a row for each contestant, drag and experiment, for each contestant and mesh of the
/// refinement (`elements`), and for each time to an error (`below`). Numbers have all digits; missing values are empty.
void write_csv(std::ostream& out, const Suite& suite);

}  // namespace chainmail::report

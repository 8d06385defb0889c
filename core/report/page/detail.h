#pragma once

#include <ostream>

#include "report/run/compare.h"

namespace chainmail::report {

/// Every figure of an object as HTML, a table a drag.
void write_details(std::ostream& out, const CaseResult& object);

}  // namespace chainmail::report

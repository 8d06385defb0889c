#pragma once

#include <ostream>

#include "report/run/suite.h"

namespace chainmail::report {

/// Writes a self-contained page: findings, the summary, the plot, times to an error, orders, and all figures.
void write_html(std::ostream& out, const Suite& suite);

}  // namespace chainmail::report

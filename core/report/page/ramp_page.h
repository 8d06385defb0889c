#pragma once

#include <ostream>
#include <span>

#include "report/page/figures.h"
#include "report/page/plot.h"
#include "report/run/machine.h"
#include "report/run/ramp.h"

namespace chainmail::report {

/// Writes the result of each algorithm, then the times at each size, as text.
void write_text(std::ostream& out, const Ramp& ramp, const Machine& machine);

/// Returns all figures of a row. JSON has them under the names of the columns in CSV.
std::span<const Figure<RampRow>> ramp_figures();

/// Writes a header, then one row per algorithm and size. Numbers have all digits.
void write_csv(std::ostream& out, const Ramp& ramp);

/// Returns a plot of the number of elements against the 99th percentile of the pass times, with a line for each
/// algorithm and real time as a strip. Times above the budget are hollow.
Plot ramp_plot(const Ramp& ramp);

}  // namespace chainmail::report

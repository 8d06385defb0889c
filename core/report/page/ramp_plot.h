#pragma once

#include "report/page/plot.h"
#include "report/run/ramp.h"

namespace chainmail::report {

/// Returns a plot of the number of elements against the 99th percentile of the pass times, with a line for each
/// algorithm and real time as a strip. Times above the budget are hollow.
Plot ramp_plot(const Ramp& ramp);

}  // namespace chainmail::report

#pragma once

#include "report/page/front.h"
#include "report/page/plot.h"
#include "report/run/suite.h"

namespace chainmail::report {

/// Returns a plot of time against mean relative error, with a panel per experiment, a mark per contestant, and a line
/// through those that no other one beats.
Plot suite_plot(const Suite& suite, const SpeedAgainstError& measure);

/// Returns the plots that a report has as files of their own.
std::vector<PlotFile> plots_of(const Suite& suite);

}  // namespace chainmail::report

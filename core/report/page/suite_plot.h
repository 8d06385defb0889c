#pragma once

#include "report/page/plot.h"
#include "report/run/suite.h"

namespace chainmail::report {

/// Returns the time of a later move against the mean relative error, with a panel per experiment and a mark per
/// contestant.
Plot suite_plot(const Suite& suite);

}  // namespace chainmail::report

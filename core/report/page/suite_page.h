#pragma once

#include <ostream>

#include "report/page/plot.h"
#include "report/page/suite_table.h"
#include "report/run/suite.h"

namespace chainmail::report {

/// Writes a header, then a row for each contestant, drag and experiment, for each contestant and mesh of the
/// refinement (`elements`), and for each time to an error (`below`). Numbers have all digits; missing values are empty.
void write_csv(std::ostream& out, const Suite& suite);

/// Returns a plot of time against mean relative error, with a panel per experiment, a mark per contestant, and a line
/// through those that no other one beats.
Plot suite_plot(const Suite& suite, const SpeedAgainstError& measure);

/// Returns the plots that a report has as files of their own.
std::vector<PlotFile> plots_of(const Suite& suite);

/// Writes a self-contained page: findings, the summary, the plot, times to an error, orders, and all figures.
void write_html(std::ostream& out, const Suite& suite);

}  // namespace chainmail::report

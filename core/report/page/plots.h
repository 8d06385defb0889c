#pragma once

#include <span>
#include <vector>

#include "report/page/plot.h"
#include "report/table/summary.h"

namespace chainmail::report {

/// The errors that a plot can show against the time of a move.
std::span<const Figure* const> plotted_errors();

/// Returns a plot of the time per move against an error, with a panel for each of these drags of an object, and a mark
/// for each contestant.
Plot error_plot(const Results& results, std::size_t object, const std::vector<std::size_t>& drags, const Figure& error);

/// Returns a plot of time against relative error, with a panel for each of these objects, a mark for each contestant, a
/// curve through those that differ only in their iterations or sweeps, and a line through those that no other one
/// beats.
Plot speed_plot(const Results& results, const std::vector<std::size_t>& objects, const SpeedAgainstError& speed);

/// Returns such a plot with a panel for each drag of an object: the time of a later move, or of the move after a cut.
Plot drags_plot(const Results& results, std::size_t object);

/// Returns a plot of elements against a figure, with a panel for each series.
Plot growth_plot(const Results& results, const Figure& figure);

/// Returns a plot of the number of elements against the 99th percentile of the pass times, with a line for each
/// algorithm and real time as a strip. Times above the budget are hollow.
Plot ramp_plot(const Results& results);

}  // namespace chainmail::report

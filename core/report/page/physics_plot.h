#pragma once

#include <array>

#include "report/page/plot.h"
#include "report/run/physics.h"

namespace chainmail::report {

/// Returns a plot of time against error on one object, with one panel per drag. A curve connects the numbers of sweeps
/// of an algorithm.
Plot physics_plot(const PhysicsObject& object);
/// Returns such a plot with one panel per object, which shows the means of its drags. There must be at least one
/// object.
Plot physics_overview(const PhysicsReport& report);
/// These three return plots of time, preparation time and error against elements, with one panel per kind of object.
Plot growth_time_plot(const std::vector<PhysicsGrowth>& growths);
Plot growth_prepare_plot(const std::vector<PhysicsGrowth>& growths);
Plot growth_error_plot(const std::vector<PhysicsGrowth>& growths);

/// The files with the overview, and with the three plots of growth in the order above.
inline constexpr std::array physics_plots{"overview.svg", "growth-time.svg", "growth-prepare.svg", "growth-error.svg"};
/// Returns the name of the file with the plot of an object; the first object is 1.
std::string object_plot(std::size_t number);
/// Returns the plots that a report has as files of their own.
std::vector<PlotFile> plots_of(const PhysicsReport& report);

}  // namespace chainmail::report

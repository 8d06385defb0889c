#pragma once

#include "report/page/plot.h"
#include "report/run/physics.h"

namespace chainmail::report {

/// Returns a plot of time against error on one object, with one panel for each drag. The numbers of sweeps of an
/// algorithm are a curve.
Plot physics_plot(const PhysicsObject& object);
/// Returns the same for all objects, with one panel for each: the means of its drags. There must be an object.
Plot physics_overview(const PhysicsReport& report);
/// Return plots of elements against time, preparation time and error, with one panel for each kind of object.
Plot growth_time_plot(const std::vector<PhysicsGrowth>& growths);
Plot growth_prepare_plot(const std::vector<PhysicsGrowth>& growths);
Plot growth_error_plot(const std::vector<PhysicsGrowth>& growths);

}  // namespace chainmail::report

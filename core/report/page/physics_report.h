#pragma once

#include <ostream>

#include "report/page/figure_table.h"
#include "report/page/plot.h"
#include "report/run/machine.h"
#include "report/run/physics.h"

namespace chainmail::report {

/// Time against error on one object, a panel a drag; the sweeps of an algorithm are a curve.
Plot physics_plot(const PhysicsObject& object);
/// The same for all objects, a panel each: the means of its drags. There must be an object.
Plot physics_overview(const PhysicsReport& report);
/// Elements against time, against what is prepared and against error, a panel each kind of object.
Plot growth_time_plot(const std::vector<PhysicsGrowth>& growths);
Plot growth_prepare_plot(const std::vector<PhysicsGrowth>& growths);
Plot growth_error_plot(const std::vector<PhysicsGrowth>& growths);

/// Relative errors and times of all objects, for a terminal: those without sweeps, and those calibrated.
FigureTable physics_summary(const PhysicsReport& report);
/// The main table of one object: relative errors and times; on a page also errors over the handle's displacement.
FigureTable physics_table(const PhysicsObject& object, bool for_text = false);
/// How far each contestant grew, and how its time did.
FigureTable growth_table(const PhysicsGrowth& growth);

/// As text, as a page that needs nothing else, and with all digits as CSV: a row a contestant, drag and object.
void write_text(std::ostream& out, const PhysicsReport& report);
void write_html(std::ostream& out, const PhysicsReport& report, const Origin& origin);
void write_csv(std::ostream& out, const PhysicsReport& report);

}  // namespace chainmail::report

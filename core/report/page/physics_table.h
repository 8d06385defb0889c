#pragma once

#include <ostream>

#include "report/page/figure_table.h"
#include "report/run/physics.h"

namespace chainmail::report {

/// Returns one drag per name, with the means of errors and times over its handles, the maximum of the largest
/// errors and the worst figures of shape. Drags without a reference solution do not count. A mean says how many
/// drags it leaves out because the contestant has no measurement there.
std::vector<PhysicsDrag> means_by_name(const PhysicsObject& object);
/// Returns the mean of all drags without a cut.
PhysicsDrag mean_of_drags(const PhysicsObject& object);

/// Returns relative errors and times of all objects for a terminal, for contestants without sweeps and calibrated ones.
FigureTable physics_summary(const PhysicsReport& report);
/// Returns the main table of one object: relative errors and times. The table of a page also has the errors divided by
/// the handle's displacement.
FigureTable physics_table(const PhysicsObject& object, bool for_text = false);
/// Returns by how much each contestant differs on turned objects.
FigureTable symmetry_table(const PhysicsReport& report);
/// Returns a table of the largest size of each contestant and the growth of its time.
FigureTable growth_table(const PhysicsGrowth& growth);

/// How to read a report whose references are on refined cells, and whether a report is one.
inline constexpr const char* how_to_read_refined =
    "In this report, the reference is on refined cells instead, as each object says, and handles are patches. The\n"
    "relative error is over the elements that are neither pinned nor in the handle: 1 for an object that does not "
    "move.\n"
    "'The same cells' are those of the object.";
bool has_refined(const PhysicsReport& report);

/// Writes the report as text.
void write_text(std::ostream& out, const PhysicsReport& report);

}  // namespace chainmail::report

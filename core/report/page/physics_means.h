#pragma once

#include "report/run/physics.h"

namespace chainmail::report {

/// Returns one drag per name, with the means of errors and times over its handles, the maximum of the largest
/// errors and the worst figures of shape. Drags without a reference solution do not count. A mean says how many
/// drags it leaves out because the contestant has no measurement there.
std::vector<PhysicsDrag> means_by_name(const PhysicsObject& object);
/// Returns the mean of all drags without a cut.
PhysicsDrag mean_of_drags(const PhysicsObject& object);

}  // namespace chainmail::report

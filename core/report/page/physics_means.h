#pragma once

#include "report/run/physics.h"

namespace chainmail::report {

/// The drags of an object by their names, each the mean over its handles: of errors and of all times; of the largest
/// errors the largest. Drags without a reference solution do not count. A contestant that is missing from one of them
/// has no mean.
std::vector<PhysicsDrag> means_by_name(const PhysicsObject& object);
/// The mean of all drags but the one with a cut.
PhysicsDrag mean_of_drags(const PhysicsObject& object);

}  // namespace chainmail::report

#pragma once

#include <vector>

#include "elastic/elastic.h"

namespace chainmail {

/// Returns the displacements of all elements (space_dimension coordinates each) in the rigid motion that comes closest
/// to those of the pins. The search for the answer to displaced pins starts there.
std::vector<double> rigid_fit(const ElasticProblem& problem);

}  // namespace chainmail

#pragma once

#include <string>
#include <vector>

#include "measure/converging_reference.h"

namespace chainmail::report {

/// Describes the levels of the references of some drags, of which there is at least one: elements, changes, how many
/// converged, and the observed orders.
std::string convergence_in_words(const std::vector<Convergence>& references);

}  // namespace chainmail::report

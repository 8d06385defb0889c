#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// A fault that keeps rows of neighbours from being those of a mesh.
struct RowFault {
  ElementId element = 0;  // the row with the fault
  std::string problem, remedy;
};

/// Returns the first neighbour that is out of range, listed twice, the element itself, or listed in only one of the two
/// rows. Row i is neighbours[first_entry[i] .. first_entry[i + 1]). Throws Cancelled.
std::optional<RowFault> find_row_fault(const std::vector<EntryId>& first_entry,
                                       const std::vector<ElementId>& neighbours, const Progress& progress);

}  // namespace chainmail

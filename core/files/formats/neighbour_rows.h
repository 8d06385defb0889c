#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// An error in rows of neighbours.
struct RowFault {
  ElementId element = 0;  // the element whose row has the error
  std::string problem, remedy;
};

/// Returns the first error: a neighbour that is out of range, listed twice, the element itself, or listed in only one
/// of the two rows; none if there is no error. Row i is neighbours[first_entry[i] .. first_entry[i + 1]). Throws
/// Cancelled.
std::optional<RowFault> find_row_fault(const std::vector<EntryId>& first_entry,
                                       const std::vector<ElementId>& neighbours, const Progress& progress);

}  // namespace chainmail

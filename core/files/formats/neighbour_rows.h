#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// What keeps rows of neighbours from being those of a mesh.
struct RowFault {
  ElementId element = 0;  // whose row it is
  std::string problem, remedy;
};

/// Looks for neighbours that are out of range, listed twice, the element itself, or listed on one side only. Row i is
/// neighbours[first_entry[i] .. first_entry[i + 1]). Throws Cancelled.
std::optional<RowFault> find_row_fault(const std::vector<EntryId>& first_entry,
                                       const std::vector<ElementId>& neighbours, const Progress& progress);

}  // namespace chainmail

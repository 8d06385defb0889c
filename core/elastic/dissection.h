#pragma once

#include <vector>

#include "elastic/simplices.h"

namespace chainmail {

/// Returns the elements that have a cell, in the order of nested dissection (George 1973). The object is halved across
/// its longest side again and again. The elements between two halves come after both.
std::vector<ElementId> dissect(const Simplices& simplices, const Mesh& mesh);

}  // namespace chainmail

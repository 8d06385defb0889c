#pragma once

#include <vector>

#include "elastic/simplices.h"

namespace chainmail {

/// The elements that have a cell, by nested dissection (George 1973): the object is halved across its longest side
/// again and again, and what parts the halves comes after both.
std::vector<ElementId> dissect(const Simplices& simplices, const Mesh& mesh);

}  // namespace chainmail

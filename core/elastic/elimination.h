#pragma once

#include <vector>

#include "elastic/simplices.h"

namespace chainmail {

/// Returns the elements that have a cell, in the order of nested dissection (George 1973). The object is halved across
/// its longest side again and again. The elements between two halves come after both.
std::vector<ElementId> dissect(const Simplices& simplices, const Mesh& mesh);

/// Returns the elements that have a cell, in an order in which factoring their stiffness takes few operations: nested
/// dissection (George 1973) or minimum degree (Amestoy, Davis and Duff 1996), whichever takes fewer. Dissection suits
/// solids of a regular shape: it halves the operations at ten thousand elements. Minimum degree suits all others.
std::vector<ElementId> elimination_order(const Simplices& simplices, const Mesh& mesh, const Progress& progress = {});

}  // namespace chainmail

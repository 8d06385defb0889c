#pragma once

#include <vector>

#include "mesh/cuts.h"

namespace chainmail {

/// What to draw of a mesh, as elements' ids for the graphics card.

/// The two ends of every link that is not cut.
std::vector<ElementId> uncutLinks(const Mesh& mesh, const Cuts& cuts);

/// The three corners of every triangle none of whose links is cut.
std::vector<ElementId> uncutFaces(const Mesh& mesh, const Cuts& cuts);

/// On a lattice: every step-th row, its elements joined where no link between them is cut.
std::vector<ElementId> coarseLinks(const Mesh& mesh, const Cuts& cuts, unsigned step);

/// One element in step², spread evenly whatever the order of the ids.
std::vector<ElementId> scattered(const Mesh& mesh, unsigned step);

/// All of the elements, or about `atMost` of them, spread evenly.
std::vector<ElementId> thinned(const std::vector<ElementId>& elements, std::size_t atMost);

}  // namespace chainmail

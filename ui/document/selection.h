#pragma once

#include <vector>

#include "mesh/cuts.h"

namespace chainmail {

/// The selected elements, ascending, and the uncut links between them.
struct Selection {
  std::vector<ElementId> elements;
  std::vector<LinkId> links;

  bool empty() const { return elements.empty(); }
};

/// How a stroke changes the previous selection.
enum class SelectionMode { replace, add, remove };

/// Returns the selection after a stroke over the elements `hit`. All lists are ascending.
std::vector<ElementId> combined(const std::vector<ElementId>& before, const std::vector<ElementId>& hit,
                                SelectionMode mode);

/// Returns the uncut links between these elements; both ascending.
std::vector<LinkId> linksAmong(const Mesh& mesh, const Cuts& cuts, const std::vector<ElementId>& elements);

}  // namespace chainmail

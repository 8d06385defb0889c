#pragma once

#include <vector>

#include "mesh/cuts.h"

namespace chainmail {

/// The elements that the select tool chose, ascending, and the links, not cut, between two of them.
struct Selection {
  std::vector<ElementId> elements;
  std::vector<LinkId> links;

  bool empty() const { return elements.empty(); }
};

/// What a stroke of the select tool does with what was selected before.
enum class SelectionMode { replace, add, remove };

/// What is selected after a stroke over `hit`. All are ascending.
std::vector<ElementId> combined(const std::vector<ElementId>& before, const std::vector<ElementId>& hit,
                                SelectionMode mode);

/// The links, not cut, whose two ends are among the elements; both ascending.
std::vector<LinkId> linksAmong(const Mesh& mesh, const Cuts& cuts, const std::vector<ElementId>& elements);

}  // namespace chainmail

#include "elastic/cut_stiffness.h"

#include <algorithm>

#include "elastic/energy.h"

namespace chainmail {
namespace {

// Above this number, the updates of the supernodes are not kept (0.5 GB).
constexpr std::size_t max_updates = std::size_t{1} << 26;

}  // namespace

std::vector<bool> gone_cells(const CellSimplices& cells, const Cuts& cuts) {
  std::vector<bool> is_gone(cells.cell_count(), false);
  for (std::size_t cell = 0; cell < is_gone.size() && cuts.count() > 0; ++cell) {
    is_gone[cell] = std::ranges::any_of(cells.links_of(cell), [&](LinkId link) { return cuts.is_cut(link); });
  }
  return is_gone;
}

CutStiffness::CutStiffness(const CellSimplices& cells, const Lame& lame, ElementId elements,
                           std::span<const ElementId> order, std::span<const ElementId> prescribed)
    : cells_(cells), lame_(lame), unknowns_(cells.simplices.dimension, elements, order, prescribed) {}

void CutStiffness::analyze(const Progress& progress) {
  stiffness_.emplace(cells_.simplices, unknowns_, progress.part(0, 0.6));
  factors_.analyze(stiffness_->matrix());
}

bool CutStiffness::factor(const std::vector<bool>& is_gone, const Progress& progress) {
  if (unknowns_.count() == 0) {
    return true;
  }
  if (!stiffness_) {
    analyze(progress.part(0, 0.1));
  }
  const std::vector<bool> elements = corners_of_changed(is_gone);
  const std::vector<int> columns = assemble(is_gone, elements);
  is_gone_ = is_gone;
  if (factors_.update_count() <= max_updates) {
    factors_.keep_updates();
  }
  return (columns.empty() && factors_.has_factors()) ||
         factors_.refactor(stiffness_->matrix(), columns, progress.part(0.1, 1));
}

/// Returns for each element if it is a corner of a cell that is gone or back since the last call.
std::vector<bool> CutStiffness::corners_of_changed(const std::vector<bool>& is_gone) const {
  const bool is_first = is_gone_.empty();
  std::vector<bool> changed(unknowns_.elements(), is_first);
  for (std::size_t s = 0; s < cells_.simplices.count() && !is_first; ++s) {
    if (const std::size_t cell = cells_.cell_of[s]; is_gone[cell] != is_gone_[cell]) {
      for (const ElementId corner : cells_.simplices.corners_of(s)) {
        changed[corner] = true;
      }
    }
  }
  return changed;
}

/// Assembles the columns of some elements. Returns them.
std::vector<int> CutStiffness::assemble(const std::vector<bool>& is_gone, const std::vector<bool>& elements) {
  const Simplices& simplices = cells_.simplices;
  std::vector<bool> columns(static_cast<std::size_t>(unknowns_.count()), false), has_cell(elements.size(), false);
  std::vector<int> list;
  const auto for_each_unknown = [&](ElementId element, auto visit) {
    const std::int32_t first = unknowns_.of(element);
    for (int k = 0; k < simplices.dimension && first != Unknowns::none; ++k) {
      visit(first + k);
    }
  };
  for (ElementId e = 0; e < elements.size(); ++e) {
    for_each_unknown(e, [&](int column) {
      if (elements[e]) {
        columns[static_cast<std::size_t>(column)] = true;
        list.push_back(column);
      }
    });
  }
  stiffness_->clear(columns);
  for (std::size_t s = 0; s < simplices.count() && !list.empty(); ++s) {
    const auto corners = simplices.corners_of(s);
    if (!is_gone[cells_.cell_of[s]] && std::ranges::any_of(corners, [&](ElementId e) { return bool(elements[e]); })) {
      stiffness_->add(s, stiffness(simplices, s, lame_), columns);
      std::ranges::for_each(corners, [&](ElementId corner) { has_cell[corner] = true; });
    }
  }
  for (ElementId e = 0; e < elements.size(); ++e) {
    if (elements[e] && !has_cell[e]) {
      for_each_unknown(e, [&](int column) { stiffness_->add_unit(column); });
    }
  }
  return list;
}

}  // namespace chainmail

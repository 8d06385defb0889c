#include "files/formats/neighbour_rows.h"

#include <algorithm>

namespace chainmail {
namespace {

std::string named(ElementId id) { return "element " + std::to_string(id); }

/// Checks rows one by one, and sorts them.
class NeighbourRows {
 public:
  NeighbourRows(const std::vector<EntryId>& first_entry, std::vector<ElementId> neighbours)
      : first_entry_(first_entry), sorted_(std::move(neighbours)) {}

  ElementId count() const { return static_cast<ElementId>(first_entry_.size() - 1); }
  std::optional<RowFault> fault_within(ElementId element);
  /// Returns the fault of a row with a neighbour that does not list it.
  std::optional<RowFault> fault_across(ElementId element) const;

 private:
  const std::vector<EntryId>& first_entry_;
  std::vector<ElementId> sorted_;
};

std::optional<RowFault> NeighbourRows::fault_within(ElementId element) {
  const auto begin = sorted_.begin() + first_entry_[element], end = sorted_.begin() + first_entry_[element + 1];
  std::sort(begin, end);
  if (begin != end && *(end - 1) >= count()) {
    return RowFault{element,
                    named(element) + " lists the neighbour " + std::to_string(*(end - 1)) + ", which is out of range",
                    "use an id from 0 to " + std::to_string(count() - 1)};
  }
  if (const auto twice = std::adjacent_find(begin, end); twice != end) {
    return RowFault{element, named(element) + " lists the neighbour " + std::to_string(*twice) + " twice",
                    "list it once"};
  }
  if (std::binary_search(begin, end, element)) {
    return RowFault{element, named(element) + " is linked to itself", "remove that neighbour"};
  }
  return std::nullopt;
}

std::optional<RowFault> NeighbourRows::fault_across(ElementId element) const {
  for (EntryId i = first_entry_[element]; i < first_entry_[element + 1]; ++i) {
    const ElementId other = sorted_[i];
    if (!std::binary_search(sorted_.begin() + first_entry_[other], sorted_.begin() + first_entry_[other + 1],
                            element)) {
      std::string problem = named(element) + " lists " + std::to_string(other);
      problem += ", but " + std::to_string(other) + " does not list " + std::to_string(element);
      return RowFault{element, problem, "list a link in both rows or in neither"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<RowFault> find_row_fault(const std::vector<EntryId>& first_entry,
                                       const std::vector<ElementId>& neighbours, const Progress& progress) {
  NeighbourRows rows(first_entry, neighbours);
  for (ElementId element = 0; element < rows.count(); ++element) {
    progress.part(0, 0.5).report(element, rows.count());
    if (auto fault = rows.fault_within(element)) {
      return fault;
    }
  }
  for (ElementId element = 0; element < rows.count(); ++element) {
    progress.part(0.5, 1).report(element, rows.count());
    if (auto fault = rows.fault_across(element)) {
      return fault;
    }
  }
  return std::nullopt;
}

}  // namespace chainmail

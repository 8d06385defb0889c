#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/split.h"

namespace chainmail {

/// The elements of an earlier mesh between which something lies, ascending, then no_element. Of more than nine, the
/// lowest: a cell has at most eight corners.
using Carrier = std::array<ElementId, 9>;

/// Where the elements lie that splits have appended to a mesh. Takes time and memory in proportion to their number.
class Carriers {
 public:
  explicit Carriers(ElementId old_count) : old_count_(old_count) {}

  void append(std::span<const SplitPoint> points);
  /// Returns the carrier of elements together. That of an old element is the element.
  Carrier of(std::span<const ElementId> elements) const;

 private:
  ElementId old_count_;
  std::vector<Carrier> appended_;
};

/// Returns the elements of a carrier.
std::span<const ElementId> elements_of(const Carrier& carrier);

}  // namespace chainmail

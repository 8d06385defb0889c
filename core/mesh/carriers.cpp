#include "mesh/carriers.h"

#include <algorithm>

namespace chainmail {
namespace {

/// Inserts an element; the highest of ten is lost.
void insert(ElementId element, Carrier& carrier) {
  const auto at = std::ranges::lower_bound(carrier, element);
  if (at != carrier.end() && *at != element) {
    std::move_backward(at, carrier.end() - 1, carrier.end());
    *at = element;
  }
}

}  // namespace

void Carriers::append(std::span<const SplitPoint> points) {
  appended_.reserve(appended_.size() + points.size());
  for (const SplitPoint& point : points) {
    appended_.push_back(of(point.of));
  }
}

Carrier Carriers::of(std::span<const ElementId> elements) const {
  Carrier result;
  result.fill(no_element);
  for (const ElementId element : elements) {
    if (element < old_count_) {
      insert(element, result);
    } else {
      std::ranges::for_each(elements_of(appended_[element - old_count_]), [&](ElementId one) { insert(one, result); });
    }
  }
  return result;
}

std::span<const ElementId> elements_of(const Carrier& carrier) {
  return {carrier.begin(), std::ranges::lower_bound(carrier, no_element)};
}

}  // namespace chainmail

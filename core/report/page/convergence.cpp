#include "report/page/convergence.h"

#include <algorithm>

#include "report/page/format.h"

namespace chainmail::report {
namespace {

/// Returns the elements of each level, as on the first of the drags, and the largest change on that level.
std::string about_levels(const std::vector<Convergence>& references) {
  std::string text;
  for (std::size_t level = 0;; ++level) {
    std::uint64_t elements = 0;
    double change = 0;
    for (const Convergence& one : references) {
      if (level < one.levels.size()) {
        elements = elements == 0 ? one.levels[level].elements : elements;
        change = std::max(change, one.levels[level].change.value_or(0));
      }
    }
    if (elements == 0) {
      return text;
    }
    text += (level == 0 ? "" : ", ") + thousands(elements) + (level == 0 ? "" : " (" + percent(change) + ")");
  }
}

std::string about_orders(const std::vector<Convergence>& references) {
  std::vector<double> orders;
  for (const Convergence& one : references) {
    if (one.order) {
      orders.push_back(*one.order);
    }
  }
  if (orders.empty()) {
    return {};
  }
  const auto [low, high] = std::ranges::minmax(orders);
  return "; observed order " + figure(low) + " to " + figure(high);
}

}  // namespace

std::string convergence_in_words(const std::vector<Convergence>& references) {
  const auto converged = std::ranges::count(references, true, &Convergence::converged);
  const auto other = std::ranges::find(references, false, &Convergence::converged);
  return "elements of the reference on refined cells (largest change from the level before): " +
         about_levels(references) + "; below " + percent(converged_change) + " in " + std::to_string(converged) +
         " of " + std::to_string(references.size()) + " drags" +
         (other == references.end() ? "" : ", in others not, because " + other->end) + about_orders(references);
}

}  // namespace chainmail::report

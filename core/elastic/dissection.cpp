#include "elastic/dissection.h"

#include <algorithm>
#include <span>

namespace chainmail {
namespace {

// Sets of at most this many elements are not split further: their factor is dense anyway.
constexpr std::size_t min_elements = 24;

class Dissection {
 public:
  Dissection(const Simplices& simplices, const Mesh& mesh)
      : simplices_(simplices), mesh_(mesh), first_(mesh.element_count() + 1, 0), half_(mesh.element_count(), 0) {
    for (const ElementId corner : simplices.corners) {
      ++first_[corner + 1];
    }
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
      first_[e + 1] += first_[e];
    }
    cells_.resize(simplices.corners.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < simplices.corners.size(); ++i) {
      cells_[next[simplices.corners[i]]++] = i / (static_cast<std::size_t>(simplices.dimension) + 1);
    }
  }

  std::vector<ElementId> order() {
    std::vector<ElementId> all;
    for (ElementId e = 0; e < mesh_.element_count(); ++e) {
      if (first_[e] != first_[e + 1]) {
        all.push_back(e);
      }
    }
    sort(all);
    return all;
  }

 private:
  double coordinate(ElementId element, int k) const {
    const auto n = static_cast<std::size_t>(mesh_.space_dimension);
    return mesh_.rest[element * n + static_cast<std::size_t>(k)];
  }

  int longest_axis(std::span<const ElementId> elements) const {
    int longest = 0;
    double length = -1;
    for (int k = 0; k < mesh_.space_dimension; ++k) {
      const auto [low, high] = std::ranges::minmax_element(elements, {}, [&](ElementId e) { return coordinate(e, k); });
      if (coordinate(*high, k) - coordinate(*low, k) > length) {
        length = coordinate(*high, k) - coordinate(*low, k);
        longest = k;
      }
    }
    return longest;
  }

  bool touches(ElementId element, std::uint32_t half) const {
    for (std::size_t i = first_[element]; i < first_[element + 1]; ++i) {
      const auto corners = simplices_.corners_of(cells_[i]);
      if (std::ranges::any_of(corners, [&](ElementId one) { return half_[one] == half; })) {
        return true;
      }
    }
    return false;
  }

  /// Orders elements: one half, the other half, then the elements between them.
  void sort(std::span<ElementId> elements) {
    if (elements.size() <= min_elements) {
      return;
    }
    const int axis = longest_axis(elements);
    const auto middle = elements.begin() + static_cast<std::ptrdiff_t>(elements.size() / 2);
    std::ranges::nth_element(elements, middle, [&](ElementId a, ElementId b) {
      const double at_a = coordinate(a, axis), at_b = coordinate(b, axis);
      return at_a != at_b ? at_a < at_b : a < b;  // the same order on every machine
    });
    const std::uint32_t left = ++halves_;
    for (auto one = elements.begin(); one != middle; ++one) {
      half_[*one] = left;
    }
    const auto between = std::partition(middle, elements.end(), [&](ElementId one) { return !touches(one, left); });
    sort({elements.begin(), middle});
    sort({middle, between});
  }

  const Simplices& simplices_;
  const Mesh& mesh_;
  std::vector<std::size_t> first_, cells_;  // of each element
  std::vector<std::uint32_t> half_;         // number of the last half that each element was in
  std::uint32_t halves_ = 0;
};

}  // namespace

std::vector<ElementId> dissect(const Simplices& simplices, const Mesh& mesh) {
  return Dissection(simplices, mesh).order();
}

}  // namespace chainmail

#include "elastic/elimination.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>
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

namespace {

/// Entries above 0, in both triangles, for pairs of elements that share a cell.
using Graph = Eigen::SparseMatrix<char>;

Graph graph_of(const Simplices& simplices, const Mesh& mesh) {
  std::vector<Eigen::Triplet<char>> pairs;
  for (std::size_t s = 0; s < simplices.count(); ++s) {
    for (const ElementId a : simplices.corners_of(s)) {
      for (const ElementId b : simplices.corners_of(s)) {
        pairs.emplace_back(static_cast<int>(a), static_cast<int>(b), 1);
      }
    }
  }
  const auto count = static_cast<Eigen::Index>(mesh.element_count());
  Graph graph(count, count);
  graph.setFromTriplets(pairs.begin(), pairs.end(), [](char, char) { return char(1); });
  return graph;
}

/// Returns the elements that have a cell, in the order of minimum degree.
std::vector<ElementId> by_degree(const Graph& graph) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), order);
  std::vector<ElementId> all;
  for (Eigen::Index i = 0; i < order.size(); ++i) {
    const int element = order.indices()[i];
    if (graph.outerIndexPtr()[element] != graph.outerIndexPtr()[element + 1]) {
      all.push_back(static_cast<ElementId>(element));
    }
  }
  return all;
}

/// Returns the sum of the squares of the column lengths of the factor, found by walking up the elimination tree (Liu
/// 1990).
double operations(const Graph& graph, const std::vector<ElementId>& order) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> position(static_cast<std::size_t>(graph.cols()), none);
  for (std::size_t i = 0; i < order.size(); ++i) {
    position[order[i]] = i;
  }
  std::vector<std::size_t> parent(order.size(), none), seen(order.size(), none), length(order.size(), 1);
  for (std::size_t row = 0; row < order.size(); ++row) {
    seen[row] = row;
    for (Graph::InnerIterator one(graph, order[row]); one; ++one) {
      for (std::size_t i = position[static_cast<std::size_t>(one.row())]; i < row && seen[i] != row; i = parent[i]) {
        parent[i] = parent[i] == none ? row : parent[i];
        ++length[i];
        seen[i] = row;
      }
    }
  }
  double sum = 0;
  for (const std::size_t one : length) {
    sum += double(one) * double(one);
  }
  return sum;
}

}  // namespace

std::vector<ElementId> elimination_order(const Simplices& simplices, const Mesh& mesh, const Progress& progress) {
  progress.report(0.0);
  const Graph graph = graph_of(simplices, mesh);
  progress.report(0.2);
  std::vector<ElementId> dissected = dissect(simplices, mesh);
  progress.report(0.4);
  std::vector<ElementId> degrees = by_degree(graph);
  progress.report(0.6);
  const double of_dissected = operations(graph, dissected);
  progress.report(0.8);
  return of_dissected < operations(graph, degrees) ? dissected : degrees;
}

}  // namespace chainmail

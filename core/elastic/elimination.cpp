#include "elastic/elimination.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <limits>

#include "elastic/dissection.h"

namespace chainmail {
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

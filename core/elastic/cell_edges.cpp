#include "elastic/cell_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "mesh/cells.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

bool has_faces_in_space(const Mesh& mesh) {
  return mesh.space_dimension == 3 && !mesh.has_cells() && !mesh.triangles.empty();
}

/// Adds the shape of a triangle: its area, and the gradients of its shape functions in a plane in which its first edge
/// is the first axis.
void add_shape(const Mesh& mesh, std::span<const ElementId> face, Simplices& cells) {
  const Point first = mesh.rest_position(face[1]) - mesh.rest_position(face[0]);
  const Point second = mesh.rest_position(face[2]) - mesh.rest_position(face[0]);
  const double width = first.norm(), twice = first.cross(second).norm();
  constexpr double flat_share = 1e-8;
  if (!(twice > flat_share * std::max(first.squaredNorm(), second.squaredNorm()))) {
    throw Error("the face of elements " + std::to_string(face[0]) + ", " + std::to_string(face[1]) + " and " +
                    std::to_string(face[2]),
                "it is flat, so it cannot resist", "remove it, or mesh the object again");
  }
  const double along = first.dot(second) / width, height = twice / width;
  cells.volumes.push_back(twice / 2);
  const double x1 = 1 / width, y1 = -along / twice, y2 = 1 / height;
  cells.gradients.insert(cells.gradients.end(), {-x1, -y1 - y2, x1, y1, 0, y2});
}

}  // namespace

Simplices build_edge_cells(const Mesh& mesh, const Cuts& cuts, const Progress& progress) {
  if (!has_faces_in_space(mesh)) {
    return build_simplices(mesh, cuts, progress);
  }
  Simplices cells;
  cells.dimension = 2;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    progress.part(0, 0.5).report(i, mesh.triangles.size());
    const auto& [a, b, c] = mesh.triangles[i];
    if (!is_cut_between(mesh, cuts, a, b) && !is_cut_between(mesh, cuts, b, c) && !is_cut_between(mesh, cuts, c, a)) {
      cells.corners.insert(cells.corners.end(), {a, b, c});
    }
  }
  if (cells.corners.empty()) {
    throw Error("object", "it has no uncut face, so it cannot resist", "uncut links");
  }
  sort_simplices(cells.corners, 3);
  const std::size_t count = cells.corners.size() / 3;
  for (std::size_t s = 0; s < count; ++s) {
    progress.part(0.5, 1).report(s, count);
    add_shape(mesh, cells.corners_of(s), cells);
  }
  return cells;
}

std::vector<WeightedEdge> edges_by_cell(const Simplices& cells) {
  const auto width = static_cast<std::size_t>(cells.dimension) + 1;
  std::vector<WeightedEdge> edges;
  edges.reserve(cells.count() * width * (width - 1) / 2);
  for (std::size_t s = 0; s < cells.count(); ++s) {
    const auto corners = cells.corners_of(s);
    const auto gradients = cells.gradients_of(s);
    for (std::size_t a = 0; a < width; ++a) {
      for (std::size_t b = a + 1; b < width; ++b) {
        edges.push_back({corners[a], corners[b],
                         -cells.volumes[s] * gradients.col(Eigen::Index(a)).dot(gradients.col(Eigen::Index(b)))});
      }
    }
  }
  return edges;
}

std::vector<WeightedEdge> sum_of_edges(std::vector<WeightedEdge> edges) {
  for (WeightedEdge& edge : edges) {
    if (edge.from > edge.to) {
      std::swap(edge.from, edge.to);
    }
  }
  std::ranges::stable_sort(edges, {}, [](const WeightedEdge& edge) { return std::tuple(edge.from, edge.to); });
  std::vector<WeightedEdge> sums;
  for (const WeightedEdge& edge : edges) {
    if (!sums.empty() && sums.back().from == edge.from && sums.back().to == edge.to) {
      sums.back().weight += edge.weight;
    } else {
      sums.push_back(edge);
    }
  }
  return sums;
}

std::vector<WeightedEdge> springs_of(const Simplices& cells, const Mesh& mesh, double modulus) {
  std::vector<WeightedEdge> edges = edges_by_cell(cells);
  const std::size_t of_cell = edges.size() / cells.count();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edges[i].weight = cells.volumes[i / of_cell];
  }
  edges = sum_of_edges(std::move(edges));
  for (WeightedEdge& edge : edges) {
    edge.weight *= modulus / (mesh.rest_position(edge.to) - mesh.rest_position(edge.from)).squaredNorm();
  }
  return edges;
}

double spring_modulus(double shear, int dimension) {
  // An edge takes 1/6, 1/3 or all of a cell; the mean of a fourth power of a direction's cosines gives the rest.
  return (dimension == 3 ? 2.5 : dimension == 2 ? 8.0 / 3 : 2) * shear;
}

double mean_length(std::span<const WeightedEdge> edges, const Mesh& mesh) {
  double sum = 0;
  for (const WeightedEdge& edge : edges) {
    sum += (mesh.rest_position(edge.to) - mesh.rest_position(edge.from)).norm();
  }
  return sum / double(edges.size());
}

}  // namespace chainmail

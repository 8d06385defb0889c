#pragma once

#include <Eigen/Core>
#include <functional>
#include <random>

#include "core/support.h"
#include "elastic/elastic.h"
#include "elastic/simplices.h"
#include "mesh/layers.h"
#include "solver/algorithms.h"

namespace chainmail::test {

using Field = std::function<Point(const Point&)>;

/// Positions, links, faces and tetrahedra of a mesh, to make another from.
inline MeshParts parts_of(const Mesh& mesh) {
  MeshParts parts;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    parts.rest.push_back(mesh.rest_position(e));
  }
  parts.links = mesh.links;
  parts.triangles = mesh.triangles;
  parts.tetrahedra = mesh.tetrahedra;
  parts.space_dimension = mesh.space_dimension;
  return parts;
}

/// The same mesh with its inner elements moved at random, up to a share of the spacing 1, so that no two cells are
/// equal.
inline MeshPointer jittered(const MeshPointer& mesh, double share = 0.2) {
  MeshParts parts = parts_of(*mesh);
  std::mt19937_64 random(7);
  const auto rim = boundary(*mesh);
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    for (int k = 0; k < mesh->space_dimension && !std::ranges::binary_search(rim, e); ++k) {
      parts.rest[e][mesh->axes[k]] += uniform(random, -share, share);
    }
  }
  return build_mesh(std::move(parts));
}

/// An object whose pinned elements have the positions that a displacement field gives them.
inline ElasticProblem pinned(const MeshPointer& mesh, std::vector<ElementId> pins, const Field& field, double poisson) {
  ElasticProblem problem{mesh, Cuts(mesh), std::move(pins), {}, {}};
  problem.options.material = {3, poisson};
  for (const ElementId pin : problem.pins) {
    const Point at = field(mesh->rest_position(pin));
    for (int k = 0; k < mesh->space_dimension; ++k) {
      problem.pinned.push_back(at[mesh->axes[k]]);
    }
  }
  return problem;
}
inline ElasticProblem pinned(const MeshPointer& mesh, std::vector<ElementId> pins, double poisson = 0.3) {
  return pinned(
      mesh, std::move(pins), [](const Point&) { return Point(Point::Zero()); }, poisson);
}

/// The elements at both ends of the x axis.
inline std::vector<ElementId> both_ends(const Mesh& mesh) {
  std::vector<ElementId> pins = layer(mesh, *find_side("left"));
  const auto right = layer(mesh, *find_side("right"));
  pins.insert(pins.end(), right.begin(), right.end());
  std::ranges::sort(pins);
  return pins;
}

/// Returns the difference between displacements and a field, coordinate by coordinate (mesh units).
inline Eigen::VectorXd apart_from(const Mesh& mesh, const std::vector<double>& displacements, const Field& field) {
  const int n = mesh.space_dimension;
  Eigen::VectorXd apart(static_cast<Eigen::Index>(displacements.size()));
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point at = field(mesh.rest_position(e));
    for (int k = 0; k < n; ++k) {
      const Eigen::Index i = Eigen::Index{e} * n + k;
      apart[i] = displacements[static_cast<std::size_t>(i)] - at[mesh.axes[static_cast<std::size_t>(k)]];
    }
  }
  return apart;
}

/// The largest difference, and the root mean square of the distances (mesh units).
inline double furthest_from(const Mesh& mesh, const std::vector<double>& displacements, const Field& field) {
  return apart_from(mesh, displacements, field).lpNorm<Eigen::Infinity>();
}
inline double rms_from(const Mesh& mesh, const std::vector<double>& displacements, const Field& field) {
  return apart_from(mesh, displacements, field).norm() / std::sqrt(double(mesh.element_count()));
}

/// Returns the slope of log error over log size, between the first and the last value.
inline double order_of(const std::vector<double>& sizes, const std::vector<double>& errors) {
  return std::log(errors.front() / errors.back()) / std::log(sizes.front() / sizes.back());
}

}  // namespace chainmail::test

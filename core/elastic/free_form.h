#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// The lattice of control points around the box of an object at rest, and the Bernstein polynomials by which each point
/// moves an element (Sederberg and Parry 1986). Indices run fastest along the first axis.
class BernsteinVolume {
 public:
  /// Creates `counts` control points along x, y and z. Axes that do not exist in the scene get none.
  BernsteinVolume(const Mesh& mesh, const std::array<std::uint32_t, 3>& counts);

  Eigen::Index count() const { return count_; }
  /// Returns the rest position of a control point (space_dimension coordinates, mesh units).
  Eigen::VectorXd rest(Eigen::Index point) const;
  /// Returns the share of the displacement of each control point by which an element moves: at least 0 each, and 1 in
  /// sum.
  Eigen::VectorXd weights(ElementId element) const;

 private:
  const Mesh& mesh_;
  std::vector<int> counts_;  // along the axes that exist
  Eigen::Index count_ = 1;
};

}  // namespace chainmail

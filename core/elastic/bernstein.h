#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// A lattice of control points about the box of an object at rest, and the Bernstein polynomials by which each moves an
/// element (Sederberg and Parry 1986). The first axis runs fastest.
class BernsteinVolume {
 public:
  /// `counts` control points along x, y and z; axes that the scene does not carry have none.
  BernsteinVolume(const Mesh& mesh, const std::array<std::uint32_t, 3>& counts);

  Eigen::Index count() const { return count_; }
  /// Where a control point is at rest (space_dimension coordinates, mesh units).
  Eigen::VectorXd rest(Eigen::Index point) const;
  /// How far an element goes with each control point: not below 0, and 1 in sum.
  Eigen::VectorXd weights(ElementId element) const;

 private:
  const Mesh& mesh_;
  std::vector<int> counts_;  // along the carried axes
  Eigen::Index count_ = 1;
};

}  // namespace chainmail

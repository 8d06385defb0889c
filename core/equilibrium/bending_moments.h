#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "elastic/surface_cells.h"
#include "equilibrium/shared_loop.h"

namespace chainmail {

/// The bending moments that answer the turns of a surface's hinges, in a thin plate of bending stiffness 1.
///
/// The moments are constant in each triangle, and their normal component is the same on both sides of a hinge: mixed
/// finite elements of lowest order (Hellan 1967; Herrmann 1967; Johnson 1973), for shells as in Neunteufel and Schöberl
/// (2019). With b = edge length times turn of each hinge and A the matrix of their complementary energy, the energy is
/// ½ bᵀ A⁻¹ b. A surface of constant curvature has exactly the energy of the plate, with any triangles; with the
/// diagonal of A alone (Grinspun et al. 2003) it depends on their shapes, and Poisson's ratio has no effect.
///
/// A⁻¹ is a polynomial in A scaled by its diagonal (Chebyshev), which is close to it where A's eigenvalues are: within
/// 10⁻⁴ for triangles that are not slivers. So it needs no factors, and a cut changes only rows around it.
class BendingMoments {
 public:
  void build(const Mesh& mesh, const SurfaceCells& cells);
  /// Sets Poisson's ratio, and which triangles of `cells`, those of before, are there.
  void set(const SurfaceCells& cells, double poisson, std::span<const std::uint8_t> is_whole);
  /// Tells that these triangles came or went.
  void update(const SurfaceCells& cells, std::span<const std::uint8_t> is_whole,
              std::span<const std::uint32_t> changed);

  /// Rest length of a hinge's edge (mesh units).
  double length(std::size_t hinge) const { return lengths_[hinge]; }
  bool is_whole(std::size_t hinge) const { return diagonal_[hinge] > 0; }
  /// Returns the stiffness of a hinge in an approximation by hinges that do not feel each other.
  double stiffness(std::size_t hinge) const { return is_whole(hinge) ? 1 / diagonal_[hinge] : 0; }
  /// Writes A⁻¹ b.
  void solve(const std::vector<double>& b, std::vector<double>& moments, const SharedLoop& shared);

 private:
  struct Corner {  // a hinge at a triangle
    std::uint32_t hinge;
    std::uint8_t side;
    std::int8_t sign;  // -1 if the hinge sees the triangle from behind
  };

  std::span<const Corner> hinges_of(std::uint32_t triangle) const {
    return std::span(corners_).subspan(first_corner_[triangle], first_corner_[triangle + 1] - first_corner_[triangle]);
  }
  Eigen::Matrix3d compliance(std::uint32_t triangle) const;
  void find_corners(const SurfaceCells& cells);
  void find_columns(const SurfaceCells& cells);
  void find_row(const SurfaceCells& cells, std::uint32_t hinge, std::span<const std::uint8_t> is_whole);
  void find_degree();
  void find_residual(const std::vector<double>& b, const std::vector<double>& moments, const SharedLoop& shared);

  double poisson_ = 0;
  std::vector<double> lengths_;
  // Of each triangle: its area times the products S_k : S_l of the moments of its sides, and tr S_k tr S_l.
  std::vector<Eigen::Matrix3d> products_, traces_;
  std::vector<std::uint32_t> first_corner_;  // of each triangle
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> first_entry_, columns_;  // of each row, apart from the diagonal
  std::vector<double> values_, diagonal_;             // 0 for a hinge that is gone
  double low_ = 0.1, high_ = 2;                       // bounds of the eigenvalues of A scaled by its diagonal
  int degree_ = 1;
  std::vector<double> residual_, direction_;
};

}  // namespace chainmail

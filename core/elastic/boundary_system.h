#pragma once

#include <Eigen/Core>
#include <vector>

#include "elastic/kelvin.h"
#include "mesh/progress.h"

namespace chainmail {

/// The factors L U = P A of a square matrix, in the memory of the matrix. Works block by block, as Eigen does, but
/// reports its progress and can be cancelled.
class DenseLu {
 public:
  DenseLu() = default;
  /// Throws Error if the matrix is singular, and Cancelled.
  explicit DenseLu(Eigen::MatrixXd&& matrix, const Progress& progress = {});

  /// Replaces right sides, one per column, by the solutions.
  void solve(Eigen::MatrixXd& columns) const;

 private:
  void factor_block(Eigen::Index first, Eigen::Index width);
  void swap_rows(Eigen::Index first, Eigen::Index width, Eigen::Index from_column, Eigen::Index columns);
  void update_rest(Eigen::Index first, Eigen::Index width, const Progress& progress);

  Eigen::MatrixXd factors_;
  std::vector<Eigen::Index> swapped_;  // step i swapped row i with row swapped_[i]
};

/// The boundary element method for one elastic solid (Brebbia 1978). Displacement and traction are constant on each
/// facet, and the boundary integral equation holds at its centroid. On each facet one of the two is known, and the
/// system computes the other.
///
/// Fields hold three coordinates per facet as rows, and any number of cases as columns. Tractions are in units of the
/// shear modulus.
class BoundarySystem {
 public:
  /// The facets enclose the solid, including its cavities, and face outward. The displacement is known on some of them
  /// (at least one), and the traction on the others. Factors a dense matrix of (3 facets)² doubles. Throws Cancelled.
  BoundarySystem(std::vector<Facet> facets, std::vector<bool> displacement_known, double poisson,
                 const Progress& progress = {});

  const std::vector<Facet>& facets() const { return facets_; }
  bool displacement_known(std::size_t facet) const { return displacement_known_[facet]; }

  struct Fields {
    Eigen::MatrixXd displacements, tractions;
  };
  /// Computes displacements and tractions on all facets from the known value of each facet.
  Fields solve(const Eigen::MatrixXd& known) const;

  /// Returns the displacement at a point inside the solid (Somigliana's identity), one case per column.
  Eigen::Matrix3Xd displacement_inside(const Point& point, const Fields& fields) const;

 private:
  void assemble(Eigen::MatrixXd& matrix, const Progress& progress);
  Eigen::MatrixXd right_sides(const Eigen::MatrixXd& known) const;

  std::vector<Facet> facets_;
  std::vector<bool> displacement_known_;
  double poisson_;
  std::vector<Eigen::Matrix3d> own_traction_;  // factor of the displacement of a facet in its own equation
  DenseLu factors_;
};

}  // namespace chainmail

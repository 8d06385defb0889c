#pragma once

#include <Eigen/Core>
#include <vector>

#include "elastic/dense_lu.h"
#include "elastic/kelvin.h"
#include "mesh/progress.h"

namespace chainmail {

/// The boundary element method for one elastic solid (Brebbia 1978): displacement and traction constant on each facet,
/// the boundary integral equation taken at its centroid. On each facet one of the two is known and the other is found.
///
/// Fields hold three coordinates a facet in each row, and any number of cases as columns. Tractions are in shear
/// moduli.
class BoundarySystem {
 public:
  /// The facets close the solid, cavities included, all looking out of it. The displacement is known on some of them
  /// (at least one), and the traction on the others. Factors the dense matrix: (3 facets)² doubles. Throws Cancelled.
  BoundarySystem(std::vector<Facet> facets, std::vector<bool> displacement_known, double poisson,
                 const Progress& progress = {});

  const std::vector<Facet>& facets() const { return facets_; }
  bool displacement_known(std::size_t facet) const { return displacement_known_[facet]; }

  struct Fields {
    Eigen::MatrixXd displacements, tractions;
  };
  /// The displacements or tractions known, facet by facet, give both everywhere.
  Fields solve(const Eigen::MatrixXd& known) const;

  /// The displacement at a point inside (Somigliana's identity), case by case.
  Eigen::Matrix3Xd displacement_inside(const Point& point, const Fields& fields) const;

 private:
  void assemble(Eigen::MatrixXd& matrix, const Progress& progress);
  Eigen::MatrixXd right_sides(const Eigen::MatrixXd& known) const;

  std::vector<Facet> facets_;
  std::vector<bool> displacement_known_;
  double poisson_;
  std::vector<Eigen::Matrix3d> own_traction_;  // what multiplies a facet's own displacement in its own equation
  DenseLu factors_;
};

}  // namespace chainmail

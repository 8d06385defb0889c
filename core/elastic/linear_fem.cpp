#include <Eigen/LU>

#include "elastic/cholesky.h"
#include "elastic/elimination.h"
#include "elastic/energy.h"
#include "elastic/methods.h"
#include "elastic/response.h"
#include "elastic/stiffness.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

/// Linear elasticity on linear elements. The matrix is factored once per object and pins.
class LinearFem final : public LinearResponse {
 public:
  LinearFem(const ElasticProblem& problem, const Progress& progress)
      : LinearResponse(problem),
        simplices_(build_simplices(*problem.mesh, problem.cuts, progress.part(0, 0.1))),
        unknowns_((check_held(simplices_, *problem.mesh, problem.pins), problem.mesh->space_dimension),
                  problem.mesh->element_count(), elimination_order(simplices_, *problem.mesh, progress.part(0.1, 0.2)),
                  problem.pins) {
    Stiffness stiffness(simplices_, unknowns_);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns_.count());
    const Lame material = lame(problem.options.material);
    for (std::size_t s = 0; s < simplices_.count(); ++s) {
      progress.part(0.2, 0.3).report(s, simplices_.count());
      const CornerMatrix of_simplex = chainmail::stiffness(simplices_, s, material);
      stiffness.add(s, of_simplex);
      add_load(s, of_simplex, load);
    }
    progress.report(0.3);
    if (unknowns_.count() > 0) {
      factor_.analyze(stiffness.matrix());
      if (!factor_.factor(stiffness.matrix(), progress.part(0.3, 1))) {
        throw Error(
            "linear FEM",
            "the stiffness matrix is not positive definite: cells are too thin, or Poisson's ratio is too close to 0.5",
            "mesh the object again, or lower Poisson's ratio");
      }
      std::vector<double> base = displacements();
      unknowns_.scatter(factor_.solve(load), base);
      set_base(std::move(base));
    }
    progress.report(1.0);
  }

 private:
  /// Adds the forces that the displacements of the pins exert on the unknowns.
  void add_load(std::size_t simplex, const CornerMatrix& of_simplex, Eigen::VectorXd& load) const {
    const int n = simplices_.dimension;
    const auto corners = simplices_.corners_of(simplex);
    CornerVector prescribed = CornerVector::Zero(of_simplex.rows());
    bool any = false;
    for (int a = 0; a <= n; ++a) {
      const ElementId corner = corners[static_cast<std::size_t>(a)];
      for (int k = 0; k < n && unknowns_.of(corner) == Unknowns::none; ++k) {
        prescribed[n * a + k] =
            displacements()[std::size_t{corner} * static_cast<std::size_t>(n) + static_cast<std::size_t>(k)];
        any = any || prescribed[n * a + k] != 0;
      }
    }
    if (!any) {
      return;
    }
    const CornerVector force = of_simplex * prescribed;
    for (int a = 0; a <= n; ++a) {
      if (const std::int32_t first = unknowns_.of(corners[static_cast<std::size_t>(a)]); first != Unknowns::none) {
        load.segment(first, n) -= force.segment(n * a, n);
      }
    }
  }

  /// Applies unit forces to the element, and scales them so that they displace it by one (Schur complement of the
  /// compliance).
  Eigen::MatrixXd respond(ElementId element, const Progress& /*progress*/) override {
    const int n = simplices_.dimension;
    const auto size = static_cast<Eigen::Index>(displacements().size());
    Eigen::MatrixXd response = Eigen::MatrixXd::Zero(size, n);
    const std::int32_t first = unknowns_.of(element);
    if (first != Unknowns::none) {
      Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(unknowns_.count(), n);
      forces.middleRows(first, n).setIdentity();
      Eigen::MatrixXd fields = factor_.solve(std::move(forces));
      const SmallMatrix compliance = fields.middleRows(first, n);
      fields *= compliance.inverse();
      std::vector<double> all(static_cast<std::size_t>(size), 0.0);
      for (int k = 0; k < n; ++k) {
        unknowns_.scatter(fields.col(k), all);
        response.col(k) = Eigen::Map<const Eigen::VectorXd>(all.data(), size);
      }
    }
    // The grabbed element is exactly at its target, without rounding. If it has no cell, it moves alone.
    response.middleRows(Eigen::Index{element} * n, n).setIdentity();
    return response;
  }

  Simplices simplices_;
  Unknowns unknowns_;
  Cholesky factor_;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_linear_fem(const ElasticProblem& problem, const Progress& progress) {
  return std::make_unique<LinearFem>(problem, progress);
}

}  // namespace chainmail

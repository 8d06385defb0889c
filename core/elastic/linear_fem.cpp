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
        pins_(problem.pins),
        lame_(lame(problem.options.material)),
        simplices_(build_simplices(*problem.mesh, problem.cuts, progress.part(0, 0.1))),
        order_((check_held(simplices_, *problem.mesh, problem.pins),
                elimination_order(simplices_, *problem.mesh, progress.part(0.1, 0.2)))),
        unknowns_(simplices_.dimension, problem.mesh->element_count(), order_, problem.pins) {
    std::vector<double> base = displacements();
    Eigen::Map<Eigen::MatrixXd> fields(base.data(), static_cast<Eigen::Index>(base.size()), 1);
    if (!solved(unknowns_, factor_, fields, progress.part(0.2, 1))) {
      // A part that hangs on one element turns about it, until the handle holds it, too.
      can_turn_ = fields.isZero(0);
      if (!can_turn_) {
        throw not_positive_definite();
      }
    }
    set_base(std::move(base));
  }

 private:
  using Fields = Eigen::Ref<Eigen::MatrixXd>;  // n rows per element, one field per column

  static Error not_positive_definite() {
    return {
        "linear FEM",
        "the stiffness matrix is not positive definite: cells are too thin, Poisson's ratio is too close to 0.5, or a "
        "part hangs on one element and can turn about it",
        "mesh the object again, lower Poisson's ratio, or pin more of the part"};
  }

  /// Factors the stiffness matrix of the unknowns, and computes them in each field from the prescribed displacements.
  /// Returns false if it is not positive definite.
  bool solved(const Unknowns& unknowns, Cholesky& factor, Fields fields, const Progress& progress) const {
    Stiffness stiffness(simplices_, unknowns, progress.part(0, 0.05));
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(unknowns.count(), fields.cols());
    for (std::size_t s = 0; s < simplices_.count(); ++s) {
      progress.part(0.05, 0.1).report(s, simplices_.count());
      const CornerMatrix of_simplex = chainmail::stiffness(simplices_, s, lame_);
      stiffness.add(s, of_simplex);
      for (Eigen::Index column = 0; column < fields.cols(); ++column) {
        add_load(s, of_simplex, unknowns, fields.col(column), loads.col(column));
      }
    }
    if (unknowns.count() > 0) {
      factor.analyze(stiffness.matrix());
      if (!factor.factor(stiffness.matrix(), progress.part(0.1, 1))) {
        return false;
      }
      unknowns.scatter(factor.solve(std::move(loads)), fields);
    }
    progress.report(1.0);
    return true;
  }

  /// Adds the forces that prescribed displacements of a field exert on the unknowns.
  void add_load(std::size_t simplex, const CornerMatrix& of_simplex, const Unknowns& unknowns,
                const Eigen::Ref<const Eigen::VectorXd>& field, Eigen::Ref<Eigen::VectorXd> load) const {
    const int n = simplices_.dimension;
    const auto corners = simplices_.corners_of(simplex);
    CornerVector prescribed = CornerVector::Zero(of_simplex.rows());
    bool any = false;
    for (int a = 0; a <= n; ++a) {
      const ElementId corner = corners[static_cast<std::size_t>(a)];
      for (int k = 0; k < n && unknowns.of(corner) == Unknowns::none; ++k) {
        prescribed[n * a + k] = field[Eigen::Index{corner} * n + k];
        any = any || prescribed[n * a + k] != 0;
      }
    }
    if (!any) {
      return;
    }
    const CornerVector force = of_simplex * prescribed;
    for (int a = 0; a <= n; ++a) {
      if (const std::int32_t first = unknowns.of(corners[static_cast<std::size_t>(a)]); first != Unknowns::none) {
        load.segment(first, n) -= force.segment(n * a, n);
      }
    }
  }

  Eigen::MatrixXd respond(std::span<const ElementId> elements, const Eigen::MatrixXd& prescribed,
                          const Progress& progress) override {
    return elements.size() == 1 && !can_turn_ ? respond_to_one(elements[0])
                                              : respond_to_many(elements, prescribed, progress);
  }

  /// Factors the stiffness matrix once more, without the handle's unknowns: for more than a few elements, that is
  /// faster than the compliance of all of them.
  Eigen::MatrixXd respond_to_many(std::span<const ElementId> elements, const Eigen::MatrixXd& prescribed,
                                  const Progress& progress) const {
    const int n = simplices_.dimension;
    std::vector<ElementId> held = pins_;
    held.insert(held.end(), elements.begin(), elements.end());
    const Unknowns unknowns(n, static_cast<ElementId>(displacements().size() / static_cast<std::size_t>(n)), order_,
                            held);
    Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(Eigen::Index(displacements().size()), prescribed.cols());
    for (std::size_t i = 0; i < elements.size(); ++i) {
      fields.middleRows(Eigen::Index{elements[i]} * n, n) = prescribed.middleRows(Eigen::Index(i) * n, n);
    }
    Cholesky factor;
    if (!solved(unknowns, factor, fields, progress)) {
      throw not_positive_definite();
    }
    return fields;
  }

  /// Applies unit forces to the element, and scales them so that they displace it by one (Schur complement of the
  /// compliance).
  Eigen::MatrixXd respond_to_one(ElementId element) const {
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
      unknowns_.scatter(fields, response);
    }
    // The grabbed element is exactly at its target, without rounding. If it has no cell, it moves alone.
    response.middleRows(Eigen::Index{element} * n, n).setIdentity();
    return response;
  }

  std::vector<ElementId> pins_;
  Lame lame_;
  Simplices simplices_;
  std::vector<ElementId> order_;  // of the unknowns
  Unknowns unknowns_;
  Cholesky factor_;  // not if a part can turn
  bool can_turn_ = false;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_linear_fem(const ElasticProblem& problem, const Progress& progress) {
  return std::make_unique<LinearFem>(problem, progress);
}

}  // namespace chainmail

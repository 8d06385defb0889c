#include "elastic/neo_hookean_xpbd.h"

#include <algorithm>
#include <array>
#include <vector>

#include "elastic/corotated.h"
#include "elastic/methods.h"
#include "elastic/time_step_solver.h"

namespace chainmail {
namespace {

// Half of XPBD's h²: with all of it, the bend of a sheet in a plane ends at an error of 0.58 instead of 0.07, and the
// indentation of a cube at 0.46 instead of 0.31.
constexpr XpbdStep neo_hookean_step{.springs_over_inertia = 1};

/// Stable neo-Hookean simplices as constraints (Macklin and Müller 2021): C = √(tr FᵀF) of the shape, with the
/// compliance 1 / (μ V), and C = det F − γ of the volume, with the compliance 1 / (λ' V). The energy ½ Σ C² / α is that
/// of quasi-Newton FEM: with λ' = λ + μ and γ = 1 + μ / λ', a simplex is at rest in its rest shape, and small strains
/// have the material's parameters.
///
/// A sweep meets both constraints of a simplex at once (Ton-That et al. 2023). Their forces balance at rest; one after
/// the other, with multipliers that begin at 0, they would move an object that nothing pulls.
template <int N>
class NeoHookeanXpbd final : public TimeStepSolver<N> {
 public:
  NeoHookeanXpbd(const ElasticProblem& problem, const Simplices& cells, const XpbdStep& step, const Progress& progress)
      : Base(problem, cells, material_springs(problem, cells), step) {
    const Lame material = lame_of_dimension(lame(problem.options.material), N);
    const double of_volume = material.lambda + material.mu;
    rest_volume_ = 1 + material.mu / of_volume;
    for (std::size_t s = 0; s < cells.count(); ++s) {
      const double inertia = 1 / (cells.volumes[s] * this->square());
      Cell cell{{}, cells.gradients_of(s).template rightCols<N>(), inertia / material.mu, inertia / of_volume};
      std::ranges::copy(cells.corners_of(s), cell.corners.begin());
      cells_.push_back(cell);
    }
    this->find_base(progress);
  }

 private:
  using Base = TimeStepSolver<N>;
  using Base::element;
  using typename Base::Element, typename Base::Square;

  struct Cell {
    std::array<ElementId, N + 1> corners;
    Square gradients;                            // of the shape functions of all corners but the first
    double shape_compliance, volume_compliance;  // over the square of the time step
  };

  /// Solves for both multipliers. That of the shape is taken over C, which leaves no root and no division by C.
  void meet(const Cell& cell) {
    std::array<Element*, N + 1> corners;
    Square edges;
    for (std::size_t k = 0; k <= N; ++k) {
      corners[k] = &element(cell.corners[k]);
    }
    for (std::size_t k = 0; k < N; ++k) {
      edges.col(Eigen::Index(k)) = corners[k + 1]->at - corners[0]->at;
    }
    const NeoHookeanConstraints<N> now(edges, cell.gradients);
    double shapes = cell.shape_compliance * now.shape, both = 0, volumes = cell.volume_compliance;
    for (std::size_t k = 0; k <= N; ++k) {
      const auto by_shape = now.by_shape.col(Eigen::Index(k)), by_volume = now.by_volume.col(Eigen::Index(k));
      shapes += corners[k]->mobility * by_shape.squaredNorm();
      both += corners[k]->mobility * by_shape.dot(by_volume);
      volumes += corners[k]->mobility * by_volume.squaredNorm();
    }
    const double determinant = shapes * volumes - both * both;
    if (determinant == 0) {  // all corners are at one point
      return;
    }
    const double beyond = now.volume - rest_volume_;
    const double of_shape = (both * beyond - volumes * now.shape) / determinant;
    const double of_volume = (both * now.shape - shapes * beyond) / determinant;
    for (std::size_t k = 0; k <= N; ++k) {
      const auto column = Eigen::Index(k);
      corners[k]->at +=
          corners[k]->mobility * (of_shape * now.by_shape.col(column) + of_volume * now.by_volume.col(column));
    }
  }

  void sweep() override {
    for (const Cell& cell : cells_) {
      meet(cell);
    }
  }

  double rest_volume_ = 1;  // γ
  std::vector<Cell> cells_;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_neo_hookean_xpbd(const ElasticProblem& problem, const XpbdStep& step,
                                                     const Progress& progress) {
  const Simplices cells = build_simplices(*problem.mesh, problem.cuts, progress.part(0, 0.2));
  switch (cells.dimension) {
    case 1:
      return std::make_unique<NeoHookeanXpbd<1>>(problem, cells, step, progress.part(0.2, 1));
    case 2:
      return std::make_unique<NeoHookeanXpbd<2>>(problem, cells, step, progress.part(0.2, 1));
    default:
      return std::make_unique<NeoHookeanXpbd<3>>(problem, cells, step, progress.part(0.2, 1));
  }
}

std::unique_ptr<ElasticSolver> make_neo_hookean_xpbd(const ElasticProblem& problem, const Progress& progress) {
  return make_neo_hookean_xpbd(problem, neo_hookean_step, progress);
}

}  // namespace chainmail

#include "elastic/xpbd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "elastic/cell_edges.h"
#include "elastic/cofactors.h"
#include "elastic/corotated.h"
#include "elastic/methods.h"
#include "elastic/time_step_solver.h"

namespace chainmail {
namespace {

/// Distance constraints on the edges, and constraints of the volume of tetrahedra, or of the area of triangles in a
/// plane (Macklin et al. 2016, 2019).
///
/// Compliances are such that the energy ½ Σ C² / α is that of an elastic material as far as springs allow. Those of
/// distances are 1 / k with k = c μ Σ V / |r|² over the cells at the edge (c = 5/2 in a solid, 8/3 in a sheet, and
/// Young's modulus on a line); springs of all directions then have the shear modulus μ and λ = μ. Those of volumes are
/// V / (λ − μ), which adds the rest of λ; there are none if λ ≤ μ, up to Poisson's ratio 1/4.
template <int N>
class Xpbd final : public TimeStepSolver<N> {
 public:
  Xpbd(const ElasticProblem& problem, const Simplices& cells, const XpbdStep& step, const Progress& progress)
      : Xpbd(problem, cells, material_springs(problem, cells), step, progress) {}

 private:
  using Base = TimeStepSolver<N>;
  using Base::element;
  using typename Base::Element, typename Base::Square, typename Base::Vector;

  Xpbd(const ElasticProblem& problem, const Simplices& cells, const std::vector<WeightedEdge>& springs,
       const XpbdStep& step, const Progress& progress)
      : Base(problem, cells, springs, step) {
    for (const auto& [from, to, stiffness] : springs) {
      distances_.push_back({from, to, (element(to).at - element(from).at).norm(), 1 / (stiffness * this->square())});
    }
    const int n = cells.dimension;
    const Lame material = lame_of_dimension(lame(problem.options.material), n);
    if (n == N && N > 1 && material.lambda > material.mu) {
      add_volumes(cells, (material.lambda - material.mu) * this->square());
    }
    this->find_base(progress);
  }

  struct Distance {
    ElementId from = 0, to = 0;
    double length = 0;      // at rest
    double compliance = 0;  // over the square of the time step
  };
  struct Volume {
    std::array<ElementId, N + 1> corners;
    double volume = 0, compliance = 0;
  };

  void add_volumes(const Simplices& cells, double stiffness) {
    for (std::size_t s = 0; s < cells.count(); ++s) {
      Volume one;
      std::ranges::copy(cells.corners_of(s), one.corners.begin());
      one.volume = slope_of(one).volume;
      one.compliance = std::abs(one.volume) / stiffness;
      volumes_.push_back(one);
    }
  }

  /// The volume of a cell, with its sign, and its derivatives by the corners.
  struct Slope {
    double volume = 0;
    std::array<Vector, N + 1> by_corner;
  };
  Slope slope_of(const Volume& one) const {
    Square edges;
    for (int k = 0; k < N; ++k) {
      edges.col(k) = element(one.corners[std::size_t(k) + 1]).at - element(one.corners[0]).at;
    }
    const Square slopes = cofactors(edges);
    Slope slope{of_box * slopes.col(0).dot(edges.col(0)), {}};
    slope.by_corner[0] = -of_box * slopes.rowwise().sum();
    for (int k = 0; k < N; ++k) {
      slope.by_corner[std::size_t(k) + 1] = of_box * slopes.col(k);
    }
    return slope;
  }

  void meet(const Distance& one) {
    Element &from = element(one.from), &to = element(one.to);
    const double mobile = from.mobility + to.mobility;
    const Vector across = to.at - from.at;
    const double size = across.norm();
    if (mobile == 0 || size == 0) {
      return;
    }
    const Vector push = (one.length - size) / (size * (mobile + one.compliance)) * across;
    to.at += to.mobility * push;
    from.at -= from.mobility * push;
  }
  void meet(const Volume& one) {
    const Slope slope = slope_of(one);
    double mobile = 0;
    for (std::size_t k = 0; k <= N; ++k) {
      mobile += element(one.corners[k]).mobility * slope.by_corner[k].squaredNorm();
    }
    if (mobile == 0) {
      return;
    }
    const double multiplier = (one.volume - slope.volume) / (mobile + one.compliance);
    for (std::size_t k = 0; k <= N; ++k) {
      Element& corner = element(one.corners[k]);
      corner.at += corner.mobility * multiplier * slope.by_corner[k];
    }
  }

  void sweep() override {
    for (const Distance& one : distances_) {
      meet(one);
    }
    for (const Volume& one : volumes_) {
      meet(one);
    }
  }

  static constexpr double of_box = N == 3 ? 1.0 / 6 : N == 2 ? 0.5 : 1;  // share of a simplex in the box of its edges

  std::vector<Distance> distances_;
  std::vector<Volume> volumes_;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const XpbdStep& step,
                                         const Progress& progress) {
  const Simplices cells = build_edge_cells(*problem.mesh, problem.cuts, progress.part(0, 0.2));
  switch (problem.mesh->space_dimension) {
    case 1:
      return std::make_unique<Xpbd<1>>(problem, cells, step, progress.part(0.2, 1));
    case 2:
      return std::make_unique<Xpbd<2>>(problem, cells, step, progress.part(0.2, 1));
    default:
      return std::make_unique<Xpbd<3>>(problem, cells, step, progress.part(0.2, 1));
  }
}

std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const Progress& progress) {
  return make_xpbd(problem, XpbdStep(), progress);
}

}  // namespace chainmail

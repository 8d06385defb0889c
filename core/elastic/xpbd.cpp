#include "elastic/xpbd.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "elastic/cell_edges.h"
#include "elastic/corotated.h"
#include "elastic/iterated.h"
#include "elastic/methods.h"

namespace chainmail {
namespace {

// The object is at rest if a time step moves no element by more than this (mean edge lengths).
constexpr double at_rest_below = 1e-10;
// It diverges if a time step moves one by this.
constexpr double diverging_move = 100;

/// Extended position based dynamics with small steps (Macklin et al. 2016, 2019): distance constraints on the edges,
/// and constraints of the volume of tetrahedra, or of the area of triangles in a plane.
///
/// Compliances are such that the energy ½ Σ C² / α is that of an elastic material as far as springs allow. Those of
/// distances are 1 / k with k = c μ Σ V / |r|² over the cells at the edge (c = 5/2 in a solid, 8/3 in a sheet, and
/// Young's modulus on a line); springs of all directions then have the shear modulus μ and λ = μ. Those of volumes are
/// V / (λ − μ), which adds the rest of λ; there are none if λ ≤ μ, up to Poisson's ratio 1/4.
///
/// An iteration is a time step: elements of equal mass go on with their velocities, less damping, and one sweep over
/// the constraints moves them back, with multipliers that begin at 0. Velocities are kept from move to move.
template <int N>
class Xpbd final : public IteratedSolver {
 public:
  Xpbd(const ElasticProblem& problem, const Simplices& cells, const XpbdStep& step, const Progress& progress)
      : IteratedSolver(problem, cells),
        iterations_(problem.options.iterations),
        kept_velocity_(1 - step.damping),
        elements_(problem.mesh->element_count()),
        motions_(elements_.size()) {
    check_held(cells, *problem.mesh, problem.pins);
    const Mesh& mesh = *problem.mesh;
    const int n = cells.dimension;
    const Lame material = lame_of_dimension(lame(problem.options.material), n);
    const auto springs = springs_of(cells, mesh, spring_modulus(material.mu, n));
    length_ = mean_length(springs, mesh);
    double mean = 0;
    for (const WeightedEdge& spring : springs) {
      mean += spring.weight / double(springs.size());
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      // From the first element, so that an object far from the origin loses no digits.
      elements_[e].at = motions_[e].rest = of(mesh.rest, e) - of(mesh.rest, 0);
    }
    const double square = step.springs_over_inertia / mean;  // of the time step, over the mass of an element
    for (const auto& [from, to, stiffness] : springs) {
      distances_.push_back({from, to, (motions_[to].rest - motions_[from].rest).norm(), 1 / (stiffness * square)});
    }
    if (n == N && N > 1 && material.lambda > material.mu) {
      add_volumes(cells, (material.lambda - material.mu) * square);
    }
    find_base(progress);
  }

 private:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  /// What the constraints read and write.
  struct Element {
    Vector at;
    double mobility = 1;  // inverse mass: 1, or 0 if the position is prescribed
  };
  struct Motion {
    Vector rest, before = Vector::Zero(), velocity = Vector::Zero();  // velocity: way in a time step
  };
  struct Distance {
    ElementId from = 0, to = 0;
    double length = 0;      // at rest
    double compliance = 0;  // over the square of the time step
  };
  struct Volume {
    std::array<ElementId, N + 1> corners;
    double volume = 0, compliance = 0;
  };

  static Eigen::Map<const Vector> of(std::span<const double> all, std::size_t element) {
    return Eigen::Map<const Vector>(all.data() + element * N);
  }

  void add_volumes(const Simplices& cells, double stiffness) {
    for (std::size_t s = 0; s < cells.count(); ++s) {
      Volume one;
      std::ranges::copy(cells.corners_of(s), one.corners.begin());
      one.volume = slope_of(one).volume;
      one.compliance = std::abs(one.volume) / stiffness;
      volumes_.push_back(one);
    }
  }

  void prescribe(const std::vector<ElementId>& prescribed, const Progress& /*progress*/) override {
    for (Element& element : elements_) {
      element.mobility = 1;
    }
    for (const ElementId element : prescribed) {
      elements_[element].mobility = 0;
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
      edges.col(k) = elements_[one.corners[std::size_t(k) + 1]].at - elements_[one.corners[0]].at;
    }
    Square slopes;  // of the determinant
    if constexpr (N == 3) {
      slopes << edges.col(1).cross(edges.col(2)), edges.col(2).cross(edges.col(0)), edges.col(0).cross(edges.col(1));
    } else if constexpr (N == 2) {
      slopes << edges(1, 1), -edges(1, 0), -edges(0, 1), edges(0, 0);
    } else {
      slopes.setOnes();
    }
    Slope slope{of_box * slopes.col(0).dot(edges.col(0)), {}};
    slope.by_corner[0] = -of_box * slopes.rowwise().sum();
    for (int k = 0; k < N; ++k) {
      slope.by_corner[std::size_t(k) + 1] = of_box * slopes.col(k);
    }
    return slope;
  }

  void meet(const Distance& one) {
    Element &from = elements_[one.from], &to = elements_[one.to];
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
      mobile += elements_[one.corners[k]].mobility * slope.by_corner[k].squaredNorm();
    }
    if (mobile == 0) {
      return;
    }
    const double multiplier = (one.volume - slope.volume) / (mobile + one.compliance);
    for (std::size_t k = 0; k <= N; ++k) {
      Element& corner = elements_[one.corners[k]];
      corner.at += corner.mobility * multiplier * slope.by_corner[k];
    }
  }

  /// Makes a time step. Returns the longest way of an element; infinity if it is not a number.
  double step() {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      motions_[e].before = elements_[e].at;
      elements_[e].at += elements_[e].mobility * kept_velocity_ * motions_[e].velocity;
    }
    for (const Distance& one : distances_) {
      meet(one);
    }
    for (const Volume& one : volumes_) {
      meet(one);
    }
    double longest = 0;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      motions_[e].velocity = elements_[e].at - motions_[e].before;
      const double way = motions_[e].velocity.norm();
      longest = way <= longest ? longest : way;  // also if it is not a number
    }
    return std::isfinite(longest) ? longest : std::numeric_limits<double>::infinity();
  }

  std::string relax(std::vector<double>& displacements, const Progress& progress) override {
    begin_at(displacements);
    double longest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < iterations_ && longest > at_rest_below * length_; ++i) {
      progress.report(double(i) / iterations_);
      longest = step();
      if (longest > diverging_move * length_) {
        stop();
        last_ = displacements;
        return "it diverged; the elements stay, but for the handle";
      }
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      if (elements_[e].mobility != 0) {
        Eigen::Map<Vector>(displacements.data() + e * N) = elements_[e].at - motions_[e].rest;
      }
    }
    last_ = displacements;
    return longest > at_rest_below * length_ ? not_converged(iterations_, longest / length_) : std::string();
  }

  void begin_at(const std::vector<double>& displacements) {
    if (!is_where_it_was(displacements)) {
      stop();
    }
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      elements_[e].at = motions_[e].rest + of(displacements, e);
    }
  }
  void stop() {
    for (Motion& motion : motions_) {
      motion.velocity.setZero();
    }
  }

  std::vector<double> kept(const std::vector<double>& displacements) const override {
    const bool knows = is_where_it_was(displacements);
    std::vector<double> velocities(displacements.size(), 0.0);
    for (std::size_t e = 0; e < motions_.size() && knows; ++e) {
      Eigen::Map<Vector>(velocities.data() + e * N) = motions_[e].velocity;
    }
    return velocities;
  }
  void keep(std::span<const double> kept, const std::vector<double>& displacements) override {
    for (std::size_t e = 0; e < motions_.size(); ++e) {
      motions_[e].velocity = of(kept, e);
    }
    last_ = displacements;
  }

  /// True if the velocities are those at these displacements. Those of prescribed elements may differ.
  bool is_where_it_was(const std::vector<double>& displacements) const {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (elements_[i / N].mobility != 0 && displacements[i] != last_[i]) {
        return false;
      }
    }
    return true;
  }

  static constexpr double of_box = N == 3 ? 1.0 / 6 : N == 2 ? 0.5 : 1;  // share of a simplex in the box of its edges

  std::uint32_t iterations_;
  double kept_velocity_;  // share of the velocity that damping leaves
  std::vector<Element> elements_;
  std::vector<Motion> motions_;
  std::vector<Distance> distances_;
  std::vector<Volume> volumes_;
  double length_ = 1;         // mean of the edges, the unit of moves (mesh units)
  std::vector<double> last_;  // displacements after the last time step
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

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

// The time step makes the mean spring this many times as stiff as the inertia of an element. It decides on how fast the
// iterations converge, not on the answer. If they diverge, it is halved, at most so often (measured).
constexpr double springs_over_inertia = 2;
constexpr int max_step_halvings = 6;
// Iterations diverge if one moves an element by this many mean edge lengths.
constexpr double diverging_move = 100;
// An answer has converged if it is estimated to be this close to the equilibrium, or hardly moves (mean edge lengths).
constexpr double converged_distance = 3e-7, last_move_below = 1e-8;
// The rate at which moves shrink is measured over so many iterations.
constexpr std::size_t rated_iterations = 32;

/// The largest moves of the last iterations, and how far the answer is estimated to be from the limit.
class ShrinkingMoves {
 public:
  void add(double move) { moves_.push_back(move); }

  /// If moves shrink by a factor per iteration, the moves that are still to come are a geometric series.
  double distance() const {
    const double last = moves_.back();
    if (last == 0 || moves_.size() <= rated_iterations) {
      return last == 0 ? 0 : std::numeric_limits<double>::infinity();
    }
    const double before = moves_[moves_.size() - 1 - rated_iterations];
    const double rate = std::pow(last / before, 1.0 / rated_iterations);
    return rate < 1 ? last * rate / (1 - rate) : std::numeric_limits<double>::infinity();
  }

 private:
  std::vector<double> moves_;
};

/// Extended position based dynamics (Macklin et al. 2016) at rest: distance constraints on the edges, and constraints
/// of the volume of tetrahedra, or of the area of triangles in a plane.
///
/// Compliances are such that the energy ½ Σ C² / α is that of an elastic material as far as springs allow. Those of
/// distances are 1 / k with k = c μ Σ V / |r|² over the cells at the edge (c = 5/2 in a solid, 8/3 in a sheet, and
/// Young's modulus on a line); springs of all directions then have the shear modulus μ and λ = μ. Those of volumes are
/// V / (λ − μ), which adds the rest of λ; there are none if λ ≤ μ, up to Poisson's ratio 1/4.
///
/// An iteration is a time step without velocities: it starts from the last positions plus h² times the forces that the
/// multipliers stand for, and corrects the multipliers by one sweep over the constraints. Implicit steps from rest to
/// rest end where the forces are in equilibrium, whatever h is. Multipliers are kept between steps: if each step began
/// with none, as in a simulation, then one sweep per step would end elsewhere.
template <int N>
class Xpbd final : public IteratedSolver {
 public:
  Xpbd(const ElasticProblem& problem, const Simplices& cells, const Progress& progress)
      : IteratedSolver(problem, cells),
        iterations_(problem.options.iterations),
        mobility_(problem.mesh->element_count(), 1) {
    check_held(cells, *problem.mesh, problem.pins);
    const int n = cells.dimension;
    const Lame material = lame_of_dimension(lame(problem.options.material), n);
    const auto springs = springs_of(cells, *problem.mesh, spring_modulus(material.mu, n));
    length_ = mean_length(springs, *problem.mesh);
    double mean = 0;
    for (const WeightedEdge& spring : springs) {
      mean += spring.weight / double(springs.size());
    }
    const double step = springs_over_inertia / mean;  // h² over the mass of an element
    const std::vector<double>& rest = problem.mesh->rest;
    add_distances(springs, rest, step);
    if (n == N && N > 1 && material.lambda > material.mu) {
      add_volumes(cells, rest, (material.lambda - material.mu) * step);
    }
    find_base(progress);
  }

 private:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  struct Distance {
    std::size_t from = 0, to = 0;
    Vector rest;
    double length = 0;      // at rest
    double compliance = 0;  // over h²
    double multiplier = 0;
  };
  struct Volume {
    std::array<std::size_t, N + 1> corners;
    Square edges;  // at rest
    double volume = 0, compliance = 0, multiplier = 0;
  };

  static Vector of(const std::vector<double>& all, std::size_t element) {
    return Eigen::Map<const Vector>(all.data() + element * N);
  }

  void add_distances(const std::vector<WeightedEdge>& springs, const std::vector<double>& rest, double step) {
    for (const auto& [from, to, stiffness] : springs) {
      const Vector apart = of(rest, to) - of(rest, from);
      distances_.push_back({from, to, apart, apart.norm(), 1 / (stiffness * step)});
    }
  }

  void add_volumes(const Simplices& cells, const std::vector<double>& rest, double stiffness) {
    for (std::size_t s = 0; s < cells.count(); ++s) {
      Volume one;
      std::ranges::copy(cells.corners_of(s), one.corners.begin());
      for (int k = 0; k < N; ++k) {
        one.edges.col(k) = of(rest, one.corners[std::size_t(k) + 1]) - of(rest, one.corners[0]);
      }
      one.volume = of_box * one.edges.determinant();
      one.compliance = std::abs(one.volume) / stiffness;
      volumes_.push_back(one);
    }
  }

  void prescribe(const std::vector<ElementId>& prescribed, const Progress& /*progress*/) override {
    std::ranges::fill(mobility_, 1.0);
    for (const ElementId element : prescribed) {
      mobility_[element] = 0;
    }
  }

  void shift(std::size_t element, const Vector& by, std::vector<double>& to) const {
    Eigen::Map<Vector>(to.data() + element * N) += mobility_[element] * by;
  }

  Vector apart(const Distance& one, const std::vector<double>& at) const {
    return one.rest + (of(at, one.to) - of(at, one.from));
  }
  void push(const Distance& one, const Vector& by, std::vector<double>& to) const {
    shift(one.to, by, to);
    shift(one.from, -by, to);
  }

  /// The volume of a cell, with its sign, and its derivatives by the corners.
  struct Slope {
    double volume = 0;
    std::array<Vector, N + 1> by_corner;
  };
  Slope slope_of(const Volume& one, const std::vector<double>& at) const {
    Square edges = one.edges;
    for (int k = 0; k < N; ++k) {
      edges.col(k) += of(at, one.corners[std::size_t(k) + 1]) - of(at, one.corners[0]);
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
  void push(const Volume& one, const Slope& slope, double by, std::vector<double>& to) const {
    for (std::size_t k = 0; k <= N; ++k) {
      shift(one.corners[k], by * slope.by_corner[k], to);
    }
  }

  /// Begins a step: moves the elements by the forces of the multipliers.
  void predict(std::vector<double>& at) {
    predicted_ = at;
    for (const Distance& one : distances_) {
      const Vector across = apart(one, at);
      const double size = across.norm();
      if (size > 0) {
        push(one, one.multiplier / size * across, predicted_);
      }
    }
    for (const Volume& one : volumes_) {
      push(one, slope_of(one, at), one.multiplier, predicted_);
    }
    std::swap(at, predicted_);
  }

  /// Corrects the multiplier of each constraint in turn. Returns how far the largest correction moves an element.
  double sweep(std::vector<double>& at) {
    double largest = 0;
    for (Distance& one : distances_) {
      const double mobile = mobility_[one.from] + mobility_[one.to];
      const Vector across = apart(one, at);
      const double size = across.norm();
      if (mobile == 0 || size == 0) {
        continue;
      }
      const double change = (one.length - size - one.compliance * one.multiplier) / (mobile + one.compliance);
      one.multiplier += change;
      push(one, change / size * across, at);
      largest = std::max(largest, std::abs(change));
    }
    for (Volume& one : volumes_) {
      const Slope slope = slope_of(one, at);
      double mobile = 0, steepest = 0;
      for (std::size_t k = 0; k <= N; ++k) {
        const double squared = slope.by_corner[k].squaredNorm();
        mobile += mobility_[one.corners[k]] * squared;
        steepest = std::max(steepest, squared);
      }
      if (mobile == 0) {
        continue;
      }
      const double change = (one.volume - slope.volume - one.compliance * one.multiplier) / (mobile + one.compliance);
      one.multiplier += change;
      push(one, slope, change, at);
      largest = std::max(largest, std::abs(change) * std::sqrt(steepest));
    }
    return largest;
  }

  std::string relax(std::vector<double>& displacements, const Progress& progress) override {
    if (!is_where_it_was(displacements)) {
      forget_forces();
    }
    const std::vector<double> start = displacements;
    ShrinkingMoves moves;
    double largest = 0;
    int halvings = 0;
    for (std::uint32_t i = 0; i < iterations_; ++i) {
      progress.report(double(i) / iterations_);
      largest = iterate(displacements);
      if (largest > diverging_move * length_) {
        if (halvings++ == max_step_halvings) {
          break;
        }
        displacements = start;
        halve_step();
        moves = {};
        continue;
      }
      moves.add(largest);
      if (largest <= last_move_below * length_ || moves.distance() <= converged_distance * length_) {
        last_ = displacements;
        return {};
      }
    }
    if (halvings > max_step_halvings) {
      displacements = start;
      forget_forces();
    }
    last_ = displacements;
    return halvings > max_step_halvings ? "it diverged; the elements stay, but for the handle"
                                        : not_converged(iterations_, largest / length_);
  }

  /// One time step. Returns how far it moves an element, or infinity if that is not a number.
  double iterate(std::vector<double>& displacements) {
    before_ = displacements;
    predict(displacements);
    double largest = sweep(displacements);
    for (std::size_t k = 0; k < before_.size(); ++k) {
      const double move = std::abs(displacements[k] - before_[k]);
      largest = move <= largest ? largest : move;  // also if it is not a number
    }
    return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
  }

  /// Halves the square of the time step, by which compliances are divided.
  void halve_step() {
    multiply_compliances(2);
    forget_forces();
  }
  void multiply_compliances(double by) {
    all_compliances_ *= by;
    for (Distance& one : distances_) {
      one.compliance *= by;
    }
    for (Volume& one : volumes_) {
      one.compliance *= by;
    }
  }

  /// The compliances, as a power of 2 of those at the beginning, and the multipliers.
  std::vector<double> kept(const std::vector<double>& displacements) const override {
    const double knows = is_where_it_was(displacements) ? 1 : 0;
    std::vector<double> kept{all_compliances_};
    for (const Distance& one : distances_) {
      kept.push_back(knows * one.multiplier);
    }
    for (const Volume& one : volumes_) {
      kept.push_back(knows * one.multiplier);
    }
    return kept;
  }
  void keep(std::span<const double> kept, const std::vector<double>& displacements) override {
    multiply_compliances(std::max(1.0, kept[0]) / all_compliances_);
    auto next = kept.begin() + 1;
    for (Distance& one : distances_) {
      one.multiplier = *next++;
    }
    for (Volume& one : volumes_) {
      one.multiplier = *next++;
    }
    last_ = displacements;
  }

  /// True if the multipliers are those of these displacements. Those of prescribed elements may differ.
  bool is_where_it_was(const std::vector<double>& displacements) const {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (mobility_[i / N] != 0 && displacements[i] != last_[i]) {
        return false;
      }
    }
    return true;
  }
  void forget_forces() {
    for (Distance& one : distances_) {
      one.multiplier = 0;
    }
    for (Volume& one : volumes_) {
      one.multiplier = 0;
    }
  }

  static constexpr double of_box = N == 3 ? 1.0 / 6 : N == 2 ? 0.5 : 1;  // share of a simplex in the box of its edges

  std::uint32_t iterations_;
  std::vector<double> mobility_;  // inverse mass of each element: 1, or 0 if its displacement is prescribed
  std::vector<Distance> distances_;
  std::vector<Volume> volumes_;
  double all_compliances_ = 1;                     // over those at the beginning: a power of 2
  double length_ = 1;                              // mean of the edges, the unit of moves (mesh units)
  std::vector<double> last_, predicted_, before_;  // iterates
};

}  // namespace

std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const Progress& progress) {
  const Simplices cells = build_edge_cells(*problem.mesh, problem.cuts, progress.part(0, 0.2));
  switch (problem.mesh->space_dimension) {
    case 1:
      return std::make_unique<Xpbd<1>>(problem, cells, progress.part(0.2, 1));
    case 2:
      return std::make_unique<Xpbd<2>>(problem, cells, progress.part(0.2, 1));
    default:
      return std::make_unique<Xpbd<3>>(problem, cells, progress.part(0.2, 1));
  }
}

}  // namespace chainmail

#include "elastic/xpbd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "elastic/cell_edges.h"
#include "elastic/energy.h"
#include "elastic/iterated.h"
#include "elastic/methods.h"

namespace chainmail {
namespace {

/// The springs that stand for the material of a problem. Their mean decides on the time step, whatever the constraints.
std::vector<WeightedEdge> material_springs(const ElasticProblem& problem, const Simplices& cells) {
  const Lame material = lame_of_dimension(lame(problem.options.material), cells.dimension);
  return springs_of(cells, *problem.mesh, spring_modulus(material.mu, cells.dimension));
}

/// Extended position based dynamics with small steps (Macklin et al. 2016, 2019), for constraints of any kind.
///
/// An iteration is a time step: elements of equal mass go on with their velocities, less damping, and one sweep over
/// the constraints moves them back, with multipliers that begin at 0. Velocities are kept from move to move.
template <int N>
class TimeStepSolver : public IteratedSolver {
 protected:
  using Vector = FixedMatrix<double, N>;
  using Square = FixedMatrix<double, N, N>;
  /// What the constraints read and write.
  struct Element {
    Vector at;            // from the first element at rest, so that an object far from the origin loses no digits
    double mobility = 1;  // inverse mass: 1, or 0 if the position is prescribed
  };

  /// `springs`: those of the material, for the time step.
  TimeStepSolver(const ElasticProblem& problem, const Simplices& cells, std::span<const WeightedEdge> springs,
                 const XpbdStep& step)
      : IteratedSolver(problem, cells),
        iterations_(problem.options.iterations),
        kept_velocity_(1 - step.damping),
        elements_(problem.mesh->element_count()),
        motions_(elements_.size()),
        length_(mean_length(springs, *problem.mesh)) {
    check_held(cells, *problem.mesh, problem.pins);
    double mean = 0;
    for (const WeightedEdge& spring : springs) {
      mean += spring.weight / double(springs.size());
    }
    square_ = step.springs_over_inertia / mean;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      elements_[e].at = motions_[e].rest = of(problem.mesh->rest, e) - of(problem.mesh->rest, 0);
    }
  }

  /// Moves the elements to meet each constraint once, in turn. The object rests elsewhere in another order, so the
  /// order is that of the ids of elements, whatever that of a file.
  virtual void sweep() = 0;

  Element& element(ElementId id) { return elements_[id]; }
  const Element& element(ElementId id) const { return elements_[id]; }
  /// The square of the time step, over the mass of an element.
  double square() const { return square_; }

 private:
  // The object is at rest if a time step moves no element by more than this (mean edge lengths).
  static constexpr double at_rest_below = 1e-10;
  // It diverges if a time step moves one by this.
  static constexpr double diverging_move = 100;

  struct Motion {
    Vector rest, before, velocity;  // velocity: way in a time step
  };

  static Vector of(std::span<const double> all, std::size_t element) { return Vector::from(all.data() + element * N); }

  void prescribe(const std::vector<ElementId>& prescribed, const Progress& /*progress*/) override {
    for (Element& element : elements_) {
      element.mobility = 1;
    }
    for (const ElementId element : prescribed) {
      elements_[element].mobility = 0;
    }
  }

  /// Makes a time step. Returns the longest way of an element; infinity if it is not a number.
  double step() {
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      motions_[e].before = elements_[e].at;
      elements_[e].at += elements_[e].mobility * kept_velocity_ * motions_[e].velocity;
    }
    sweep();
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
        std::copy_n((elements_[e].at - motions_[e].rest).data(), N, displacements.data() + e * N);
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
      motion.velocity = {};
    }
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

  std::uint32_t iterations_;
  double kept_velocity_;  // share of the velocity that damping leaves
  double square_ = 0;
  std::vector<Element> elements_;
  std::vector<Motion> motions_;
  double length_ = 1;         // mean of the edges, the unit of moves (mesh units)
  std::vector<double> last_;  // displacements after the last time step
};

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
      set_column(edges, k, element(one.corners[std::size_t(k) + 1]).at - element(one.corners[0]).at);
    }
    const Square slopes = of_box * transposed(adjugate(edges));
    Slope slope{column(slopes, 0).dot(column(edges, 0)), {}};
    for (int k = 0; k < N; ++k) {
      slope.by_corner[std::size_t(k) + 1] = column(slopes, k);
      slope.by_corner[0] -= column(slopes, k);
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

/// Makes the solver for a number of dimensions.
template <template <int> class Solver>
std::unique_ptr<ElasticSolver> make_in(int dimensions, const ElasticProblem& problem, const Simplices& cells,
                                       const XpbdStep& step, const Progress& progress) {
  switch (dimensions) {
    case 1:
      return std::make_unique<Solver<1>>(problem, cells, step, progress);
    case 2:
      return std::make_unique<Solver<2>>(problem, cells, step, progress);
    default:
      return std::make_unique<Solver<3>>(problem, cells, step, progress);
  }
}

}  // namespace

std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const XpbdStep& step,
                                         const Progress& progress) {
  const Simplices cells = build_edge_cells(*problem.mesh, problem.cuts, progress.part(0, 0.2));
  return make_in<Xpbd>(problem.mesh->space_dimension, problem, cells, step, progress.part(0.2, 1));
}

std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const Progress& progress) {
  return make_xpbd(problem, XpbdStep(), progress);
}

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
      const auto gradients = Square::from(cells.gradients_of(s).data() + N);
      Cell cell{{}, gradients, inertia / material.mu, inertia / of_volume};
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
    for (int k = 0; k < N; ++k) {
      set_column(edges, k, corners[std::size_t(k) + 1]->at - corners[0]->at);
    }
    const NeoHookeanConstraints<N> now(edges, cell.gradients);
    double shapes = cell.shape_compliance * now.shape, both = 0, volumes = cell.volume_compliance;
    for (std::size_t k = 0; k <= N; ++k) {
      const auto by_shape = column(now.by_shape, int(k)), by_volume = column(now.by_volume, int(k));
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
      corners[k]->at +=
          corners[k]->mobility * (of_shape * column(now.by_shape, int(k)) + of_volume * column(now.by_volume, int(k)));
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
  return make_in<NeoHookeanXpbd>(cells.dimension, problem, cells, step, progress.part(0.2, 1));
}

std::unique_ptr<ElasticSolver> make_neo_hookean_xpbd(const ElasticProblem& problem, const Progress& progress) {
  return make_neo_hookean_xpbd(problem, neo_hookean_step, progress);
}

}  // namespace chainmail

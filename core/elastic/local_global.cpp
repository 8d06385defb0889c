#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "elastic/cell_edges.h"
#include "elastic/cholesky.h"
#include "elastic/closest_rotation.h"
#include "elastic/elastic.h"
#include "elastic/elimination.h"
#include "elastic/energy.h"
#include "elastic/iterated.h"
#include "elastic/methods.h"
#include "elastic/stiffness.h"
#include "mesh/error.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {
namespace {

/// Solves a symmetric positive definite system by elimination.
template <int Size>
FixedMatrix<double, Size> solved(FixedMatrix<double, Size, Size> lower, FixedMatrix<double, Size> right) {
  for (int k = 0; k < Size; ++k) {
    for (int i = k + 1; i < Size; ++i) {
      const double factor = lower(i, k) / lower(k, k);
      right[i] -= factor * right[k];
      for (int j = k + 1; j <= i; ++j) {
        lower(i, j) -= factor * lower(j, k);
      }
    }
  }
  for (int k = Size - 1; k >= 0; --k) {
    for (int i = k + 1; i < Size; ++i) {
      right[k] -= lower(i, k) * right[i];
    }
    right[k] /= lower(k, k);
  }
  return right;
}

/// Anderson acceleration of a fixed-point iteration x ← x + f(x) (Peng et al. 2018): from the last steps, it
/// extrapolates to where the next step would be shortest. The limit is the same.
class Anderson {
 public:
  explicit Anderson(Eigen::Index size) : steps_(size, window), ends_(size, window) {}

  void restart() { seen_ = 0; }

  /// Returns the next iterate, from the step f(x) and its end x + f(x).
  Eigen::VectorXd next(const Eigen::VectorXd& step, const Eigen::VectorXd& end) {
    if (seen_ > 0) {
      const int slot = (seen_ - 1) % window;
      steps_.col(slot) = step - last_step_;
      ends_.col(slot) = end - last_end_;
      multiply(slot);
    } else {
      products_ = Products::Identity();
    }
    last_step_ = step;
    last_end_ = end;
    const int used = std::min(seen_++, window);
    FixedMatrix<double, window> shares;
    for (int i = 0; i < used; ++i) {
      shares[i] = steps_.col(i).dot(step);
    }
    shares = solved(products_, shares);
    if (!std::isfinite(shares.squaredNorm())) {
      return end;
    }
    Eigen::VectorXd next = end;
    for (int i = 0; i < used; ++i) {
      next -= shares[i] * ends_.col(i);
    }
    return next;
  }

 private:
  static constexpr int window = 6;        // 5 to 8 work alike (Peng et al. 2018)
  static constexpr double ridge = 1e-12;  // steps of nearly the same direction have no unique shares
  using Products = FixedMatrix<double, window, window>;

  /// Multiplies a new change of a step with all others that are there.
  void multiply(int slot) {
    for (int i = 0; i < std::min(seen_, window); ++i) {
      products_(i, slot) = products_(slot, i) = steps_.col(i).dot(steps_.col(slot));
    }
    products_(slot, slot) *= 1 + ridge;
  }

  Eigen::MatrixXd steps_, ends_;  // changes of the last steps and of their ends
  Products products_;             // of the changes of steps; of the identity where there are none
  Eigen::VectorXd last_step_, last_end_;
  int seen_ = 0;
};

/// A local/global energy (Sorkine and Alexa 2007; Bouaziz et al. 2014). With the vector d of an edge and its vector r
/// at rest, it is
///
///     ½ Σ over groups  min over rotations R  Σ over their edges  w |d − R r|²   +   ½ Σ over springs  k (|d| − |r|)²
///
/// Its iterations choose the rotations and the directions of the springs for given positions, and then the positions
/// for these by one solution with a matrix that never changes.
struct LocalGlobalEnergy {
  Simplices cells;  // whose elements move
  std::vector<WeightedEdge> edges;
  std::vector<std::size_t> group_ends;  // of each group, among `edges`
  std::vector<WeightedEdge> springs;
};

// An answer has converged if the next step is below this share of the mean edge length.
constexpr double last_step_below = 1e-9;
// An accelerated iterate is dropped if the energy rises by more than this share of it, which is more than rounding.
constexpr double allowed_rise = 1e-12;

template <int N>
class LocalGlobal final : public IteratedSolver {
 public:
  LocalGlobal(const char* name, const ElasticProblem& problem, LocalGlobalEnergy energy, std::uint32_t iterations,
              const Progress& progress)
      : IteratedSolver(problem, energy.cells),
        name_(name),
        elements_(problem.mesh->element_count()),
        iterations_(iterations),
        group_ends_(std::move(energy.group_ends)),
        order_(elimination_order(energy.cells, *problem.mesh, progress.part(0, 0.2))),
        rotations_(group_ends_.size(), Square::Identity()),
        gradient_(problem.mesh->rest.size()) {
    check_held(energy.cells, *problem.mesh, problem.pins);
    const auto& longest = energy.edges.empty() ? energy.springs : energy.edges;
    length_ = mean_length(longest, *problem.mesh);
    edges_ = with_rest(energy.edges, *problem.mesh);
    springs_ = with_rest(energy.springs, *problem.mesh);
    find_base(progress.part(0.2, 1));
  }

 private:
  using Vector = FixedMatrix<double, N>;
  using Square = FixedMatrix<double, N, N>;
  struct Edge {
    std::size_t from = 0, to = 0;
    double weight = 0;
    Vector rest;
  };

  static std::vector<Edge> with_rest(const std::vector<WeightedEdge>& edges, const Mesh& mesh) {
    std::vector<Edge> result;
    result.reserve(edges.size());
    for (const auto& [from, to, weight] : edges) {
      const auto at = [&](ElementId e) { return Vector::from(mesh.rest.data() + std::size_t{e} * N); };
      result.push_back({from, to, weight, at(to) - at(from)});
    }
    return result;
  }

  void prescribe(const std::vector<ElementId>& prescribed, const Progress& progress) override {
    unknowns_ = Unknowns(1, elements_, order_, prescribed);
    if (unknowns_.count() == 0) {
      return;
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::vector<Edge>* edges : {&edges_, &springs_}) {
      for (const Edge& edge : *edges) {
        add_to_matrix(edge, entries);
      }
    }
    Cholesky::Sparse matrix(unknowns_.count(), unknowns_.count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    factor_.analyze(matrix);
    if (!factor_.factor(matrix, progress)) {
      throw Error(name_, "its matrix is not positive definite: cells are too thin", "mesh the object again");
    }
  }

  /// Adds an edge to the lower triangle of the matrix of the unknowns.
  void add_to_matrix(const Edge& edge, std::vector<Eigen::Triplet<double>>& entries) const {
    const std::int32_t a = unknowns_.of(ElementId(edge.from)), b = unknowns_.of(ElementId(edge.to));
    for (const std::int32_t one : {a, b}) {
      if (one != Unknowns::none) {
        entries.emplace_back(one, one, edge.weight);
      }
    }
    if (a != Unknowns::none && b != Unknowns::none) {
      entries.emplace_back(std::max(a, b), std::min(a, b), -edge.weight);
    }
  }

  Vector apart(const Edge& edge, const std::vector<double>& displacements) const {
    return edge.rest +
           (Vector::from(displacements.data() + edge.to * N) - Vector::from(displacements.data() + edge.from * N));
  }

  void pull(const Edge& edge, const Vector& force) {
    for (int k = 0; k < N; ++k) {
      gradient_[edge.to * N + std::size_t(k)] += force[k];
      gradient_[edge.from * N + std::size_t(k)] -= force[k];
    }
  }

  /// The local step: turns the groups. Returns the energy, and its derivatives in gradient_.
  double evaluate(const std::vector<double>& displacements) {
    std::ranges::fill(gradient_, 0.0);
    double twice = 0;
    std::size_t begin = 0;
    for (std::size_t g = 0; g < group_ends_.size(); ++g) {
      const std::size_t end = group_ends_[g];
      Square sum;
      for (std::size_t i = begin; i < end; ++i) {
        sum += outer_product(edges_[i].weight * apart(edges_[i], displacements), edges_[i].rest);
      }
      turn_to_closest(sum, rotations_[g]);
      for (std::size_t i = begin; i < end; ++i) {
        const Vector off = apart(edges_[i], displacements) - rotations_[g] * edges_[i].rest;
        twice += edges_[i].weight * off.squaredNorm();
        pull(edges_[i], edges_[i].weight * off);
      }
      begin = end;
    }
    for (const Edge& spring : springs_) {
      const Vector across = apart(spring, displacements);
      const double now = across.norm(), longer = now - spring.rest.norm();
      twice += spring.weight * longer * longer;
      if (now > 0) {
        pull(spring, spring.weight * longer / now * across);
      }
    }
    return twice / 2;
  }

  /// The unknown coordinates: N columns, one after another.
  Eigen::VectorXd gather(const std::vector<double>& all) const {
    Eigen::VectorXd unknown(N * unknowns_.count());
    for (ElementId e = 0; e < elements_; ++e) {
      for (int k = 0; k < N && unknowns_.of(e) != Unknowns::none; ++k) {
        unknown[k * unknowns_.count() + unknowns_.of(e)] = all[std::size_t{e} * N + std::size_t(k)];
      }
    }
    return unknown;
  }
  void scatter(const Eigen::VectorXd& unknown, std::vector<double>& all) const {
    for (ElementId e = 0; e < elements_; ++e) {
      for (int k = 0; k < N && unknowns_.of(e) != Unknowns::none; ++k) {
        all[std::size_t{e} * N + std::size_t(k)] = unknown[k * unknowns_.count() + unknowns_.of(e)];
      }
    }
  }

  Eigen::VectorXd global_step() const {
    const Eigen::VectorXd forces = gather(gradient_);
    return -factor_.solve(forces.reshaped(unknowns_.count(), N)).reshaped();
  }

  std::string relax(std::vector<double>& displacements, const Progress& progress) override {
    if (unknowns_.count() == 0) {
      return {};
    }
    Eigen::VectorXd now = gather(displacements), end = now, step;
    Anderson anderson(now.size());
    double before = INFINITY;
    for (std::uint32_t i = 0; i < iterations_; ++i) {
      progress.report(double(i) / iterations_);
      scatter(now, displacements);
      double energy = evaluate(displacements);
      if (!(energy <= before * (1 + allowed_rise))) {  // back to the plain iterate, which never raises it
        anderson.restart();
        scatter(end, displacements);
        now = end;
        energy = evaluate(displacements);
      }
      before = energy;
      step = global_step();
      end = now + step;
      if (step.lpNorm<Eigen::Infinity>() <= last_step_below * length_) {
        scatter(end, displacements);
        return {};
      }
      now = anderson.next(step, end);
    }
    scatter(end, displacements);
    return not_converged(iterations_, step.lpNorm<Eigen::Infinity>() / length_);
  }

  const char* name_;
  ElementId elements_;
  std::uint32_t iterations_;
  std::vector<Edge> edges_, springs_;
  std::vector<std::size_t> group_ends_;
  double length_ = 1;             // mean of the edges, the unit of steps (mesh units)
  std::vector<ElementId> order_;  // of the unknowns
  Unknowns unknowns_{1, 0, {}, {}};
  Cholesky factor_;
  std::vector<Square> rotations_;  // of the groups
  std::vector<double> gradient_;   // of the energy, by all coordinates
};

/// Makes a solver that stops once a step is below a small share of the mean edge length, or after `iterations`.
std::unique_ptr<ElasticSolver> make_local_global(const char* name, const ElasticProblem& problem,
                                                 LocalGlobalEnergy energy, std::uint32_t iterations,
                                                 const Progress& progress) {
  switch (problem.mesh->space_dimension) {
    case 1:
      return std::make_unique<LocalGlobal<1>>(name, problem, std::move(energy), iterations, progress);
    case 2:
      return std::make_unique<LocalGlobal<2>>(name, problem, std::move(energy), iterations, progress);
    default:
      return std::make_unique<LocalGlobal<3>>(name, problem, std::move(energy), iterations, progress);
  }
}

/// Returns the edges about each element, as groups. Each cotangent counts as 0 if it is negative, as in CGAL's
/// Surface_mesh_deformation: negative weights would let an element run away.
void group_spokes(LocalGlobalEnergy& energy) {
  std::vector<WeightedEdge> edges = edges_by_cell(energy.cells);
  for (WeightedEdge& edge : edges) {
    edge.weight = std::max(edge.weight, 0.0);
  }
  std::vector<WeightedEdge> spokes;
  for (const WeightedEdge& edge : sum_of_edges(std::move(edges))) {
    if (edge.weight > 0) {
      spokes.push_back(edge);
      spokes.push_back({edge.to, edge.from, edge.weight});
    }
  }
  std::ranges::stable_sort(spokes, {}, &WeightedEdge::from);
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    if (i + 1 == spokes.size() || spokes[i + 1].from != spokes[i].from) {
      energy.group_ends.push_back(i + 1);
    }
  }
  energy.edges = std::move(spokes);
}

// Springs resist at most with this share of the shear modulus, so that the cells keep some resistance of their own.
constexpr double max_spring_fraction = 0.75;

}  // namespace

/// As-rigid-as-possible deformation (Sorkine and Alexa 2007): on sheets and surfaces, the edges about each element turn
/// together, with cotangent weights. In solids, the edges of each tetrahedron do (Chao et al. 2010): with weights of
/// either sign, groups about elements could lose energy without bound. The material has no effect.
std::unique_ptr<ElasticSolver> make_arap(const ElasticProblem& problem, const Progress& progress) {
  LocalGlobalEnergy energy;
  energy.cells = build_edge_cells(*problem.mesh, problem.cuts, progress.part(0, 0.1));
  if (energy.cells.dimension == 3) {
    energy.edges = edges_by_cell(energy.cells);
    for (std::size_t end = 6; end <= energy.edges.size(); end += 6) {
      energy.group_ends.push_back(end);
    }
  } else {
    group_spokes(energy);
  }
  return make_local_global("ARAP", problem, std::move(energy), problem.options.iterations, progress.part(0.1, 1));
}

/// Projective Dynamics (Bouaziz et al. 2014) at rest: springs on the edges, and corotated cells,
///     W = μc |F − R|²  per volume.
/// Springs of all directions resist like an isotropic solid whose Lamé parameters are equal. They take the material's
/// λ, or 3/4 of its μ if that is less, and the cells the rest of μ: then the shear modulus is the material's, and so is
/// Poisson's ratio up to 0.21 in a solid. Above that, the object is more compressible than the material. The answer is
/// the minimum of the energy, and so has no time step.
std::unique_ptr<ElasticSolver> make_projective(const ElasticProblem& problem, const Progress& progress) {
  LocalGlobalEnergy energy;
  energy.cells = build_edge_cells(*problem.mesh, problem.cuts, progress.part(0, 0.1));
  const int n = energy.cells.dimension;
  const Lame material = lame_of_dimension(lame(problem.options.material), n);
  const double of_springs = n == 1 ? material.mu : std::min(material.lambda, max_spring_fraction * material.mu);
  if (of_springs > 0) {
    energy.springs = springs_of(energy.cells, *problem.mesh, spring_modulus(of_springs, n));
  }
  if (n > 1) {
    energy.edges = edges_by_cell(energy.cells);
    for (WeightedEdge& edge : energy.edges) {
      edge.weight *= 2 * (material.mu - of_springs);
    }
    const auto of_cell = std::size_t(n == 3 ? 6 : 3);
    for (std::size_t end = of_cell; end <= energy.edges.size(); end += of_cell) {
      energy.group_ends.push_back(end);
    }
  }
  return make_local_global("Projective Dynamics", problem, std::move(energy), problem.options.iterations,
                           progress.part(0.1, 1));
}

}  // namespace chainmail

#include "elastic/local_global.h"

#include <cmath>
#include <span>

#include "elastic/anderson.h"
#include "elastic/cholesky.h"
#include "elastic/closest_rotation.h"
#include "elastic/elimination.h"
#include "elastic/iterated.h"
#include "elastic/stiffness.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

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
  using Vector = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  struct Edge {
    std::size_t from = 0, to = 0;
    double weight = 0;
    Vector rest;
  };

  static std::vector<Edge> with_rest(const std::vector<WeightedEdge>& edges, const Mesh& mesh) {
    std::vector<Edge> result;
    result.reserve(edges.size());
    for (const auto& [from, to, weight] : edges) {
      const auto at = [&](ElementId e) { return Eigen::Map<const Vector>(mesh.rest.data() + std::size_t{e} * N); };
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
    const double* from = displacements.data() + edge.from * N;
    const double* to = displacements.data() + edge.to * N;
    return edge.rest + (Eigen::Map<const Vector>(to) - Eigen::Map<const Vector>(from));
  }

  void pull(const Edge& edge, const Vector& force) {
    Eigen::Map<Vector>(gradient_.data() + edge.to * N) += force;
    Eigen::Map<Vector>(gradient_.data() + edge.from * N) -= force;
  }

  /// The local step: turns the groups. Returns the energy, and its derivatives in gradient_.
  double evaluate(const std::vector<double>& displacements) {
    std::ranges::fill(gradient_, 0.0);
    double twice = 0;
    std::size_t begin = 0;
    for (std::size_t g = 0; g < group_ends_.size(); ++g) {
      const std::size_t end = group_ends_[g];
      Square sum = Square::Zero();
      for (std::size_t i = begin; i < end; ++i) {
        sum.noalias() += edges_[i].weight * apart(edges_[i], displacements) * edges_[i].rest.transpose();
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

}  // namespace

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

}  // namespace chainmail

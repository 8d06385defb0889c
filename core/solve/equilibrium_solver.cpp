#include "solve/equilibrium_solver.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "mesh/error.h"
#include "solve/body_view.h"
#include "solve/corotated.h"
#include "solve/link_energy.h"
#include "solve/multigrid.h"
#include "solve/path_search.h"
#include "solve/repair.h"
#include "solve/valid_projection.h"

namespace chainmail {
namespace {

// Stiffness against the distance from the valid region, as a multiple of the link's own stiffness: at the beginning,
// and its limits. Few binding links converge best with little, many with much.
constexpr double first_penalty = 2, least_penalty = 0.2, largest_penalty = 100;
// The penalty changes by this factor after 6, 12, 24, ... steps if one of the two residuals is larger than the other by
// these ratios (after Boyd et al. 2011, section 3.4.1; the ratios were found by trials on sheets and blocks).
constexpr double penalty_factor = 3, too_stiff = 1.9, too_soft = 0.7;
constexpr int first_penalty_check = 6;
constexpr double over_relaxation = 1.7;
// Steps of conjugate gradients per step of the method of multipliers.
constexpr int inner_steps = 1;
// The gradient is computed anew after this many steps, so that rounding does not add up.
constexpr int steps_per_gradient = 30;
// Lateral stiffness of the preconditioner for the corotated energy, per stiffness along the link.
constexpr double turned_share = 0.1;
// Valid regions count from this residual on: before, the iterate may violate links only because it has not converged.
constexpr double binds_below = 0.2;
// They count no more if none has a force while the residual is below this.
constexpr double frees_below = 0.01;

/// Displacements from rest, in double, as repair and projection see a body.
template <int D>
struct Displacements {
  using Scalar = double;
  static constexpr int Dimension = D;

  bool pinned(ElementId element) const { return body->is_pinned(element); }
  template <class Visit>
  void for_each_neighbour(ElementId element, Visit visit) const {
    chainmail::for_each_neighbour(*mesh, body->cuts(), element, visit);
  }

  const Mesh* mesh = nullptr;
  const Body* body = nullptr;
  std::vector<Position<double, D>> positions;
  RegionTable<double, D> regions;
};

/// A matrix in float with its multigrid, both brought up to date when they are used.
template <int D>
class Preconditioner {
 public:
  using Matrix = LinkMatrix<double, D>;
  using Vectors = typename Matrix::Vectors;

  void reset() { *this = Preconditioner(); }
  /// Notes that the blocks in these rows, or whether they are fixed, have changed. `cut`: because links were cut.
  void outdate(std::span<const ElementId> rows, bool cut) {
    if (grid_.is_built()) {
      outdated_.insert(outdated_.end(), rows.begin(), rows.end());
      cut_ = cut_ || cut;
    }
    if (outdated_.size() > std::size_t{matrix_.size()}) {
      reset();  // it is built anew when it is needed
    }
  }

  /// `change` makes the blocks of the approximated matrix from those of `matrix`.
  template <class Change>
  void update(const MeshPointer& mesh, const Matrix& matrix, Change change) {
    if (!grid_.is_built() || outdated_.size() > matrix.size() / 4) {
      build(mesh, matrix, change);
    } else if (!outdated_.empty()) {
      for (const ElementId row : outdated_) {
        copy_row(matrix, row, change);
      }
      grid_.repair(matrix_, outdated_, cut_);
    }
    outdated_.clear();
    cut_ = false;
  }

  void apply(const Vectors& right, Vectors& result) {
    double largest = 0;
    for (const auto& one : right) {
      largest = std::max(largest, one.cwiseAbs().maxCoeff());
    }
    const double scale = largest > 0 ? 1 / largest : 1;
    right_.resize(right.size());
    for (std::size_t i = 0; i < right.size(); ++i) {
      right_[i] = (right[i] * scale).template cast<float>();
    }
    grid_.cycle(matrix_, right_, result_);
    result.resize(right.size());
    for (std::size_t i = 0; i < right.size(); ++i) {
      result[i] = result_[i].template cast<double>() / scale;
    }
  }

 private:
  static LinkBlock<float, D> rounded(const LinkBlock<double, D>& block) {
    return {block.along.template cast<float>(), static_cast<float>(block.across)};
  }

  template <class Change>
  void build(const MeshPointer& mesh, const Matrix& matrix, Change change) {
    matrix_ = LinkMatrix<float, D>(mesh);
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      matrix_.set_link(link, rounded(change(matrix.link(link))));
    }
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      matrix_.set_fixed(e, matrix.is_fixed(e));
    }
    grid_.build(matrix_);
  }

  template <class Change>
  void copy_row(const Matrix& matrix, ElementId row, Change change) {
    const Mesh& mesh = matrix.mesh();
    matrix_.set_fixed(row, matrix.is_fixed(row));
    for (EntryId entry = mesh.first_entry[row]; entry < mesh.first_entry[row + 1]; ++entry) {
      matrix_.set_link(mesh.entry_link[entry], rounded(change(matrix.link(mesh.entry_link[entry]))));
    }
  }

  LinkMatrix<float, D> matrix_;
  Multigrid<D> grid_;
  std::vector<ElementId> outdated_;
  bool cut_ = false;
  std::vector<Eigen::Matrix<float, D, 1>> right_, result_;
};

/// Conjugate gradients with a preconditioner, one step at a time. The iterate belongs to the caller.
template <int D>
class ConjugateGradients {
 public:
  using Matrix = LinkMatrix<double, D>;
  using Vectors = typename Matrix::Vectors;

  /// Begins with this negative gradient.
  Vectors& begin() {
    is_fresh_ = true;
    return rest_;
  }

  /// Runs a step. Returns by how much the energy decreases.
  double step(const Matrix& matrix, Preconditioner<D>& preconditioner, Vectors& x) {
    preconditioner.apply(rest_, scaled_);
    const double slope = dot(rest_, scaled_);
    if (!(slope > 0)) {
      slope_ = 0;
      return 0;
    }
    // After Polak and Ribière, which forgives a preconditioner in float.
    const double bend = is_fresh_ ? 0 : std::max(0.0, -step_ * dot(product_, scaled_) / slope_);
    way_.resize(rest_.size());
    for (std::size_t i = 0; i < way_.size(); ++i) {
      way_[i] = is_fresh_ ? scaled_[i] : scaled_[i] + bend * way_[i];
    }
    slope_ = slope;
    is_fresh_ = false;
    matrix.apply(way_, product_);
    const double curvature = dot(way_, product_), along = dot(rest_, way_);
    if (!(curvature > 0)) {
      return 0;
    }
    step_ = along / curvature;
    const double before = dot(rest_, rest_);
    double after = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += step_ * way_[i];
      rest_[i] -= step_ * product_[i];
      after += rest_[i].squaredNorm();
    }
    shrunk_ = before > 0 ? std::sqrt(after / before) : 0;
    return step_ * along / 2;
  }

  /// Estimates the distance of the iterate from the minimum, in the norm of the energy, after the last step.
  double distance() const { return std::sqrt(std::max(0.0, slope_)) * shrunk_; }
  /// The same before the last step.
  double distance_before() const { return std::sqrt(std::max(0.0, slope_)); }

 private:
  static double dot(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += a[i].dot(b[i]);
    }
    return sum;
  }

  bool is_fresh_ = true;
  double slope_ = 0, step_ = 0, shrunk_ = 1;
  Vectors rest_, scaled_, way_, product_;
};

/// A quasi-Newton method with a preconditioner in place of the first approximation of the inverse (L-BFGS; Nocedal
/// 1980), one step at a time. What it has learned about the curvature stays when the handle moves.
template <int D>
class QuasiNewton {
 public:
  using Vectors = std::vector<Eigen::Matrix<double, D, 1>>;

  void forget() { pairs_.clear(); }

  /// Runs a step from `x`, with the energy and its negative gradient there, which are updated. `evaluate(x, force)`
  /// returns the energy. Returns false if no step lowers the energy.
  template <class Evaluate>
  bool step(Evaluate evaluate, Preconditioner<D>& preconditioner, Vectors& x, double& energy, Vectors& force) {
    find_way(preconditioner, force);
    const double slope = dot(way_, force);
    slope_ = std::max(0.0, slope);
    if (!(slope > 0)) {
      forget();
      return false;
    }
    before_ = force;
    start_ = x;
    double length = 1;
    for (int i = 0; i < most_tries; ++i, length *= 0.5) {
      for (std::size_t e = 0; e < x.size(); ++e) {
        x[e] = start_[e] + length * way_[e];
      }
      const double next = evaluate(x, force);
      if (next <= energy - 1e-4 * length * slope + 1e-13 * energy) {
        energy = next;
        learn(length, force);
        const double was = dot(before_, before_);
        shrunk_ = was > 0 ? std::min(1.0, std::sqrt(dot(force, force) / was)) : 0;
        return true;
      }
    }
    x = start_;
    force = before_;
    forget();
    return false;
  }

  /// Estimates the distance from the minimum in the norm of the energy, after the last step.
  double distance() const { return std::sqrt(slope_) * shrunk_; }

 private:
  static constexpr std::size_t most_pairs = 6;
  static constexpr int most_tries = 12;

  struct Pair {
    Vectors step, change;  // of the position, and of the gradient
    double product = 0;    // step · change
  };

  static double dot(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      sum += a[i].dot(b[i]);
    }
    return sum;
  }
  static void add(Vectors& sum, double factor, const Vectors& other) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += factor * other[i];
    }
  }

  void find_way(Preconditioner<D>& preconditioner, const Vectors& force) {
    rest_ = force;
    std::vector<double> shares(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      shares[i] = dot(pairs_[i].step, rest_) / pairs_[i].product;
      add(rest_, -shares[i], pairs_[i].change);
    }
    preconditioner.apply(rest_, way_);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      add(way_, shares[i] - dot(pairs_[i].change, way_) / pairs_[i].product, pairs_[i].step);
    }
  }

  void learn(double length, const Vectors& force) {
    Pair pair;
    if (pairs_.size() == most_pairs) {
      pair = std::move(pairs_.front());
      pairs_.erase(pairs_.begin());
    }
    pair.step.assign(way_.size(), Eigen::Matrix<double, D, 1>::Zero());
    add(pair.step, length, way_);
    pair.change = before_;
    add(pair.change, -1, force);
    pair.product = dot(pair.step, pair.change);
    if (pair.product > 1e-12 * std::sqrt(dot(pair.step, pair.step) * dot(pair.change, pair.change))) {
      pairs_.push_back(std::move(pair));
    }
  }

  std::vector<Pair> pairs_;  // oldest first
  Vectors rest_, way_, before_, start_;
  double slope_ = 0, shrunk_ = 1;
};

template <int D>
class Equilibrator final : public EquilibriumSolver {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Vectors = std::vector<Vector>;
  using Projection = ValidProjection<Displacements<D>>;

  void iterate(Body& body, std::span<const ElementId> held, const Progress& progress) override {
    progress.report(0);
    follow(body, held);
    step();
    show(body);
  }

  bool solve(Body& body, std::span<const ElementId> held, double residual, int most,
             const Progress& progress) override {
    follow(body, held);
    bool reached = false;
    for (int i = 0; i < most && !reached; ++i) {
      progress.report(double(i) / most);
      const bool was_constrained = constrained_;
      step();
      reached = residual_ <= residual && constrained_ == was_constrained;
    }
    show(body);
    return reached;
  }

  double residual() const override { return residual_; }
  std::span<const ElementId> moved() const override { return moved_; }
  double largest_step() const override { return largest_step_; }

  EquilibriumCertificate certificate(Body& body) override {
    EquilibriumCertificate result;
    result.residual = residual_;
    result.binds = constrained_;
    result.iterations = iterations_;
    read(body);
    if (kind_ != EnergyKind::corotated) {
      result.gap = relative_gap();
    }
    result.violation = largest_violation();
    return result;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // What the body was when it was last seen.

  void follow(Body& body, std::span<const ElementId> held) {
    const Revisions& now = body.revisions();
    const bool is_new = shown_.mesh != &body.mesh();
    if (is_new) {
      begin(body);
    }
    shown_.body = &body;
    if (is_new || now.softness != seen_.softness) {
      shown_.regions.set(*mesh_, body.softness(), true);
    }
    if (is_new || now.energy != seen_.energy) {
      take_energy(body);
    }
    if (is_new || now.energy != seen_.energy || now.cuts != seen_.cuts) {
      update_links(body);
    }
    read(body);
    if (is_new || now.positions != seen_.positions) {
      for (std::size_t e = 0; e < iterate_.size(); ++e) {
        iterate_[e] = vector_of(shown_.positions[e]);
      }
      corotated_.reset();
      newton_.forget();
      end_constraints();
    }
    const bool other_fixed = is_new || now.pins != seen_.pins || !std::ranges::equal(held, held_);
    if (other_fixed) {
      held_.assign(held.begin(), held.end());
      update_fixed(body);
    }
    if (other_fixed || now.positions != seen_.positions || now.energy != seen_.energy || now.cuts != seen_.cuts) {
      hold_lone_frames();
    }
    make_valid(body);
    hold_fixed();
    seen_ = body.revisions();
  }

  void begin(const Body& body) {
    mesh_ = body.mesh_pointer();
    shown_.mesh = mesh_.get();
    shown_.positions.resize(mesh_->element_count());
    iterate_.resize(mesh_->element_count());
    energy_ = LinkMatrix<double, D>(mesh_);
    newton_.forget();
    fixed_.assign(mesh_->element_count(), 0);
    scale_ = 0;
    free_.reset();
    penalised_.reset();
    constrained_ = false;
    penalised_matrix_.reset();
  }

  static Vector vector_of(const Position<double, D>& position) {
    Vector result;
    for (int k = 0; k < D; ++k) {
      result[k] = position[k];
    }
    return result;
  }

  void read(const Body& body) {
    const PositionView positions = body.positions();
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      for (int k = 0; k < D; ++k) {
        shown_.positions[e][k] = positions(e, k) - mesh_->rest[std::size_t{e} * D + std::size_t(k)];
      }
    }
    epsilon_ = body.precision() == Precision::single_precision ? std::numeric_limits<float>::epsilon()
                                                               : std::numeric_limits<double>::epsilon();
    largest_ = 0;
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      for (int k = 0; k < D; ++k) {
        const double stored = body.stores_displacements() ? shown_.positions[e][k] : positions(e, k);
        largest_ = std::max(largest_, std::abs(stored));
      }
    }
    tolerance_ = 16 * epsilon_ * largest_;
  }

  Vector rest_vector(LinkId link) const {
    const auto [i, j] = mesh_->links[link];
    Vector r;
    for (int k = 0; k < D; ++k) {
      r[k] = mesh_->rest[std::size_t{j} * D + std::size_t(k)] - mesh_->rest[std::size_t{i} * D + std::size_t(k)];
    }
    return r;
  }

  LinkBlock<double, D> block_of(const Body& body, LinkId link) const {
    if (body.cuts().is_cut(link)) {
      return {};
    }
    const LinkWeights weights = link_weights(*mesh_, body.softness(), link);
    const Vector r = rest_vector(link);
    const double length = r.norm();
    if (!(length > 0) && weights.lateral == 0) {
      return {Vector::Zero(), 1};  // its region leaves no room for a deflection, so any stiffness will do
    }
    return {length > 0 ? Vector(r / length * std::sqrt(weights.axial / scale_)) : Vector(Vector::Zero()),
            weights.lateral / scale_};
  }

  /// Returns the mean over the links of their stiffness: it keeps the numbers in float near 1.
  double mean_weight(const Body& body) const {
    double sum = 0;
    for (LinkId link = 0; link < mesh_->link_count(); ++link) {
      const LinkWeights weights = link_weights(*mesh_, body.softness(), link);
      sum += (weights.axial + weights.lateral) / mesh_->link_count();
    }
    return sum > 0 && std::isfinite(sum) ? sum : 1;
  }

  /// A kind of energy, and a stiffness of another order of magnitude, need everything anew.
  void take_energy(const Body& body) {
    const double mean = mean_weight(body);
    if (kind_ != body.softness().energy || !(mean < 10 * scale_ && mean > scale_ / 10)) {
      kind_ = body.softness().energy;
      scale_ = mean;
      free_.reset();
      penalised_.reset();
      penalised_matrix_.reset();
      end_constraints();
    }
  }

  void update_links(const Body& body) {
    std::vector<ElementId> rows;
    bool cut = false;
    for (LinkId link = 0; link < mesh_->link_count(); ++link) {
      const LinkBlock<double, D> block = block_of(body, link);
      const LinkBlock<double, D>& present = energy_.link(link);
      if (block.along != present.along || block.across != present.across) {
        energy_.set_link(link, block);
        if (penalised_matrix_) {
          penalised_matrix_->set_link(link, with_penalty(block));
        }
        if (constrained_ && block.is_zero()) {
          multiplier_[link].setZero();
          inside_[link].setZero();
        }
        rows.insert(rows.end(), {mesh_->links[link][0], mesh_->links[link][1]});
        cut = cut || body.cuts().is_cut(link);
      }
    }
    free_.outdate(rows, cut);
    penalised_.outdate(rows, cut);
    newton_.forget();
    is_fresh_ = true;
    iterations_ = 0;
  }

  /// Returns the block of the matrix that approximates the curvature of the energy.
  static LinkBlock<double, D> softened(LinkBlock<double, D> block) {
    // Where the lateral part turns with its neighbourhood, it resists large motions little.
    block.across = std::min(block.across, turned_share * block.along.squaredNorm());
    return block;
  }
  LinkBlock<double, D> with_penalty(LinkBlock<double, D> block) const {
    const double all = penalty_of(block);
    if (kind_ == EnergyKind::corotated) {  // a bound of the curvature, whatever the rotations are
      return {Vector::Zero(), block.along.squaredNorm() + block.across + all};
    }
    block.across += all;
    return block;
  }
  double penalty_of(const LinkBlock<double, D>& block) const {
    return penalty_ * (block.along.squaredNorm() + block.across);
  }

  void update_fixed(const Body& body) {
    std::vector<std::uint8_t> fixed(mesh_->element_count());
    for (const ElementId pin : body.pins()) {
      fixed[pin] = 1;
    }
    for (const ElementId element : held_) {
      fixed[element] = 1;
    }
    std::vector<ElementId> rows;
    for (ElementId e = 0; e < fixed.size(); ++e) {
      if (fixed[e] != fixed_[e]) {
        energy_.set_fixed(e, fixed[e] != 0);
        if (penalised_matrix_) {
          penalised_matrix_->set_fixed(e, fixed[e] != 0);
        }
        rows.push_back(e);
        const auto neighbours = mesh_->neighbours_of(e);
        rows.insert(rows.end(), neighbours.begin(), neighbours.end());
      }
    }
    fixed_ = std::move(fixed);
    free_.outdate(rows, false);
    penalised_.outdate(rows, false);
    newton_.forget();
    is_fresh_ = true;
    iterations_ = 0;
  }

  /// A part that only one element holds could turn about it without energy. The frame of this element holds it then.
  void hold_lone_frames() {
    std::vector<ElementId> alone;
    std::vector<std::uint8_t> seen(fixed_.size());
    std::vector<ElementId> part;
    for (ElementId first = 0; kind_ == EnergyKind::corotated && first < seen.size(); ++first) {
      if (fixed_[first] == 0 || seen[first] != 0) {
        continue;
      }
      part.assign(1, first);
      seen[first] = 1;
      std::size_t fixed = 0;
      for (std::size_t i = 0; i < part.size(); ++i) {
        fixed += fixed_[part[i]];
        shown_.for_each_neighbour(part[i], [&](ElementId neighbour, EntryId) {
          if (std::exchange(seen[neighbour], 1) == 0) {
            part.push_back(neighbour);
          }
        });
      }
      if (fixed == 1) {
        alone.push_back(first);
      }
    }
    corotated_.hold_frames(std::move(alone));
  }

  /// Repairs the shown state if an algorithm left it invalid.
  void make_valid(Body& body) {
    if (projection().is_valid(shown_.positions)) {
      return;
    }
    Repair repair(shown_, search_, std::max(largest_, body.reach().since_rest), held_, epsilon_);
    repair.run(body.pins());
  }

  /// Moves the fixed elements of the iterate to where they are.
  void hold_fixed() {
    for (std::size_t e = 0; e < fixed_.size(); ++e) {
      if (fixed_[e] != 0 && iterate_[e] != vector_of(shown_.positions[e])) {
        iterate_[e] = vector_of(shown_.positions[e]);
        is_fresh_ = true;
        iterations_ = 0;
      }
    }
  }

  // Iterations.

  void step() {
    constrained_ ? constrained_step() : free_step();
    ++iterations_;
    if (!constrained_ && residual_ < binds_below && !projection().is_valid(iterate_)) {
      begin_constraints();
    }
  }

  void free_step() {
    update_free();
    if (kind_ == EnergyKind::corotated) {
      newton_step();
      return;
    }
    if (is_fresh_ || ++steps_since_gradient_ > steps_per_gradient) {
      energy_of_iterate_ = gradient(iterate_, gradients_.begin());
      is_fresh_ = false;
      steps_since_gradient_ = 0;
    }
    energy_of_iterate_ -= gradients_.step(energy_, free_, iterate_);
    note_distance(gradients_.distance());
  }

  /// The energy of deflections that nobody sees: the residual of an object at rest is relative to this.
  double unseen_energy() const {
    const double deflection = 1e-5 * mesh_->mean_link_length;
    return mesh_->link_count() * deflection * deflection + std::numeric_limits<double>::min();
  }
  void note_distance(double distance) {
    const double relative = distance / std::sqrt(2 * std::max(0.0, energy_of_iterate_) + unseen_energy());
    residual_ = std::isfinite(relative) ? relative : 1;
  }

  void update_free() {
    if (kind_ == EnergyKind::corotated) {
      free_.update(mesh_, energy_, [](const LinkBlock<double, D>& block) { return softened(block); });
    } else {
      free_.update(mesh_, energy_, std::identity());
    }
  }

  void newton_step() {
    if (is_fresh_) {
      energy_of_iterate_ = gradient(iterate_, force_);
      is_fresh_ = false;
    }
    const auto evaluate = [&](const Vectors& at, Vectors& force) { return gradient(at, force); };
    // Without what it has learned, a step fails only where rounding hides the way down.
    const bool lowered = newton_.step(evaluate, free_, iterate_, energy_of_iterate_, force_) ||
                         newton_.step(evaluate, free_, iterate_, energy_of_iterate_, force_);
    note_distance(lowered ? newton_.distance() : 0);
  }

  /// Writes the negative gradient of the energy at these displacements, and returns the energy.
  double gradient(const Vectors& at, Vectors& rest) {
    double energy = 0;
    if (kind_ == EnergyKind::corotated) {
      energy = corotated_.evaluate(
          *mesh_,
          [&](LinkId link) {
            const LinkBlock<double, D>& block = energy_.link(link);
            return typename CorotatedEnergy<D>::Link{block.along.squaredNorm(), block.across};
          },
          at, &rest);
    } else {
      energy = linear_gradient(at, rest);
    }
    energy_.clear_fixed(rest);
    return energy;
  }

  double linear_gradient(const Vectors& at, Vectors& rest) const {
    rest.assign(at.size(), Vector::Zero());
    double energy = 0;
    for (LinkId link = 0; link < mesh_->link_count(); ++link) {
      const auto [i, j] = mesh_->links[link];
      const Vector apart = at[j] - at[i], force = energy_.link(link).times(apart);
      energy += apart.dot(force) / 2;
      rest[i] += force;
      rest[j] -= force;
    }
    return energy;
  }

  void begin_constraints() {
    constrained_ = true;
    multiplier_.assign(mesh_->link_count(), Vector::Zero());
    inside_.resize(mesh_->link_count());
    for_each_link([&](LinkId link, ElementId i, ElementId j, const Region<double, D>& region) {
      inside_[link] = clamped_to(region, iterate_[j] - iterate_[i]);
    });
    constrained_steps_ = 0;
    residual_ = 1;  // of the free minimum, it says nothing now
    next_penalty_check_ = first_penalty_check;
    if (!penalised_matrix_) {
      set_penalty(first_penalty);
    }
  }

  void set_penalty(double penalty) {
    penalty_ = penalty;
    penalised_matrix_.emplace(energy_);
    for (LinkId link = 0; link < mesh_->link_count(); ++link) {
      penalised_matrix_->set_link(link, with_penalty(energy_.link(link)));
    }
    penalised_.reset();
  }

  void adapt_penalty(double outside, double stepped) {
    if (++constrained_steps_ < next_penalty_check_) {
      return;
    }
    next_penalty_check_ *= 2;
    const double ratio = outside > 0 ? std::sqrt(stepped / outside) : 1;
    const double wanted = ratio > too_stiff  ? penalty_ / penalty_factor
                          : ratio < too_soft ? penalty_ * penalty_factor
                                             : penalty_;
    const double before = penalty_;
    if (wanted != before && wanted >= least_penalty && wanted <= largest_penalty) {
      set_penalty(wanted);
      for (Vector& one : multiplier_) {
        one *= before / wanted;
      }
    }
  }

  void end_constraints() {
    constrained_ = false;
    is_fresh_ = true;
  }

  /// Calls visit(link, i, j, region) for each link that counts, with i < j and the region of j about i.
  template <class Visit>
  void for_each_link(Visit visit) const {
    for (ElementId i = 0; i < mesh_->element_count(); ++i) {
      shown_.for_each_neighbour(i, [&](ElementId j, EntryId entry) {
        if (j > i && (fixed_[i] == 0 || fixed_[j] == 0)) {
          visit(mesh_->entry_link[entry], i, j, shown_.regions[entry]);
        }
      });
    }
  }

  static Vector clamped_to(const Region<double, D>& region, Vector apart) {
    for (int k = 0; k < D; ++k) {
      apart[k] = std::min(std::max(apart[k], region.low[k]), region.high[k]);
    }
    return apart;
  }

  /// One step of the method of multipliers: an approximate minimum of the energy with springs to where each link was
  /// inside its region, then clamps into the regions, then the multipliers.
  void constrained_step() {
    penalised_.update(mesh_, *penalised_matrix_, std::identity());
    Vectors& rest = gradients_.begin();
    energy_of_iterate_ = gradient(iterate_, rest);
    for_each_link([&](LinkId link, ElementId i, ElementId j, const Region<double, D>&) {
      const Vector apart = iterate_[j] - iterate_[i];
      const Vector force = penalty_of(energy_.link(link)) * (inside_[link] - multiplier_[link] - apart);
      rest[i] -= force;
      rest[j] += force;
    });
    energy_.clear_fixed(rest);
    for (int i = 0; i < inner_steps; ++i) {
      gradients_.step(*penalised_matrix_, penalised_, iterate_);
    }
    is_fresh_ = true;
    double outside = 0, stepped = 0, size = 0, active = 0;
    for_each_link([&](LinkId link, ElementId i, ElementId j, const Region<double, D>& region) {
      const double weight = penalty_of(energy_.link(link));
      const Vector apart = iterate_[j] - iterate_[i];
      const Vector relaxed = over_relaxation * apart + (1 - over_relaxation) * inside_[link];
      const Vector before = inside_[link], wanted = relaxed + multiplier_[link];
      inside_[link] = clamped_to(region, wanted);
      multiplier_[link] = wanted - inside_[link];  // exactly 0 inside the region
      outside += weight * (apart - inside_[link]).squaredNorm();
      stepped += weight * (before - inside_[link]).squaredNorm();
      size += weight * apart.squaredNorm();
      active += multiplier_[link].squaredNorm();
    });
    residual_ = std::sqrt(std::max(outside, stepped) / (size + unseen_energy()));
    if (active == 0 && residual_ < frees_below && projection().is_valid(iterate_)) {
      end_constraints();
    } else {
      adapt_penalty(outside, stepped);
    }
  }

  // What the user sees.

  Projection projection() const { return Projection(shown_, fixed_, tolerance_); }

  void show(Body& body) {
    Projection to_valid = projection();
    if (!to_valid.is_valid(iterate_)) {
      to_valid.run(shown_.positions, iterate_);
    } else {
      for (std::size_t e = 0; e < iterate_.size(); ++e) {
        for (int k = 0; k < D; ++k) {
          shown_.positions[e][k] = fixed_[e] != 0 ? shown_.positions[e][k] : iterate_[e][k];
        }
      }
    }
    write(body);
  }

  void write(Body& body) {
    moved_.clear();
    largest_step_ = 0;
    body.with_view([&]<class View>(const View& view) {
      if constexpr (View::Dimension == D) {
        for (ElementId e = 0; e < shown_.positions.size(); ++e) {
          const auto before = view.positions[e];
          double square = 0;
          for (int k = 0; k < D; ++k) {
            view.set_position(e, k, mesh_->rest[std::size_t{e} * D + std::size_t(k)] + shown_.positions[e][k]);
            const double step = double(view.positions[e][k]) - double(before[k]);
            square += step * step;
          }
          if (square > 0) {
            moved_.push_back(e);
            largest_step_ = std::max(largest_step_, square);
          }
        }
      }
    });
    largest_step_ = std::sqrt(largest_step_);
    if (!moved_.empty()) {
      body.note_relaxation();
    }
  }

  // The certificate.

  /// Returns by how much the energy of the shown state exceeds a lower bound of that of all valid states (the value of
  /// Lagrange's dual function), relative to the energy.
  double relative_gap() {
    const Vectors& at = iterate_;
    Vectors rest(at.size(), Vector::Zero());
    double energy = 0, bound = 0;
    for (LinkId link = 0; link < mesh_->link_count(); ++link) {
      const auto [i, j] = mesh_->links[link];
      const Vector shown = vector_of(shown_.positions[j]) - vector_of(shown_.positions[i]);
      energy += shown.dot(energy_.link(link).times(shown)) / 2;
      const Vector apart = at[j] - at[i], force = energy_.link(link).times(apart);
      bound += apart.dot(force) / 2;
      rest[i] += force;
      rest[j] -= force;
    }
    if (constrained_) {
      for_each_link([&](LinkId link, ElementId i, ElementId j, const Region<double, D>& region) {
        const Vector force = penalty_of(energy_.link(link)) * multiplier_[link];
        bound += force.dot(at[j] - at[i]);
        for (int k = 0; k < D; ++k) {
          bound -= force[k] > 0 ? force[k] * region.high[k] : force[k] * region.low[k];
        }
        rest[i] += force;
        rest[j] -= force;
      });
    }
    energy_.clear_fixed(rest);
    update_free();
    Vectors step;
    free_.apply(rest, step);
    double decrease = 0;
    for (std::size_t e = 0; e < rest.size(); ++e) {
      decrease += rest[e].dot(step[e]);
    }
    bound -= decrease / 2;
    return energy > 0 ? std::max(0.0, energy - bound) / energy : 0;
  }

  double largest_violation() const {
    double largest = 0;
    for_each_link([&](LinkId link, ElementId i, ElementId j, const Region<double, D>& region) {
      const Vector apart = vector_of(shown_.positions[j]) - vector_of(shown_.positions[i]);
      const double outside = (apart - clamped_to(region, apart)).norm(), length = rest_vector(link).norm();
      largest = std::max(largest, outside / (length > 0 ? length : mesh_->mean_link_length));
    });
    return largest;
  }

  MeshPointer mesh_;
  Revisions seen_;
  std::vector<ElementId> held_;  // ascending
  std::vector<std::uint8_t> fixed_;
  Displacements<D> shown_;  // a valid state
  double epsilon_ = 0;      // relative rounding error of the body's numbers
  double largest_ = 0;      // largest of these numbers (mesh units)
  double tolerance_ = 0;    // up to which links are valid (mesh units)
  EnergyKind kind_ = EnergyKind::isotropic;
  double scale_ = 0;  // by which the stiffness of links is divided
  PathSearch search_;

  LinkMatrix<double, D> energy_;
  Preconditioner<D> free_;
  std::optional<LinkMatrix<double, D>> penalised_matrix_;
  Preconditioner<D> penalised_;

  Vectors iterate_;  // displacements
  ConjugateGradients<D> gradients_;
  CorotatedEnergy<D> corotated_;
  QuasiNewton<D> newton_;
  Vectors force_;         // the negative gradient, for the quasi-Newton method
  bool is_fresh_ = true;  // the gradient must be computed anew
  int steps_since_gradient_ = 0;
  double energy_of_iterate_ = 0;
  double residual_ = 0;
  int iterations_ = 0;

  bool constrained_ = false;  // valid regions bind
  double penalty_ = first_penalty;
  int constrained_steps_ = 0, next_penalty_check_ = 0;
  Vectors inside_;      // of each link: its difference of displacements, clamped into the region
  Vectors multiplier_;  // of each link: its force, divided by the penalty

  std::vector<ElementId> moved_;
  double largest_step_ = 0;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> EquilibriumSolver::make(int space_dimension) {
  switch (space_dimension) {
    case 1:
      return std::make_unique<Equilibrator<1>>();
    case 2:
      return std::make_unique<Equilibrator<2>>();
    default:
      return std::make_unique<Equilibrator<3>>();
  }
}

}  // namespace chainmail

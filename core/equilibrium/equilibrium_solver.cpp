#include "equilibrium/equilibrium_solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "body/body_view.h"
#include "equilibrium/block_vectors.h"
#include "equilibrium/conjugate_gradients.h"
#include "equilibrium/corotated.h"
#include "equilibrium/linear_prediction.h"
#include "equilibrium/link_energy.h"
#include "equilibrium/material_minimum.h"
#include "equilibrium/quasi_newton.h"
#include "equilibrium/region_constraints.h"
#include "equilibrium/valid_projection.h"
#include "exact/restore_validity.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// The gradient is computed anew after this many steps, so that rounding does not add up.
constexpr int steps_per_gradient = 30;
// Lateral stiffness of the preconditioner for the corotated energy, as a share of the larger stiffness of the link.
constexpr double turned_share = 0.3;
// Valid regions count from this residual on: before, the iterate may violate links only because it has not converged.
constexpr double binds_below = 0.2;
// They count no more if none has a force while the residual is below this.
constexpr double frees_below = 0.01;
// A frame has converged, so that the next one can be extrapolated from it, if its residual is below this.
constexpr double predicts_below = 0.1;

/// Displacements from rest, in double, as RestoreValidity and the projection see a body.
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

/// Two states are kept, as displacements from rest: the iterate, which goes to the equilibrium and may violate regions,
/// and the shown state, which is valid and is written into the body. Each iteration follows what has changed in the
/// body, takes a step of the minimiser of the kind of energy, and shows the valid state next to the iterate.
template <int D>
class Equilibrator final : public EquilibriumSolver {
 public:
  using Vectors = BlockVectors<double, D>;
  using Vector = typename Vectors::value_type;
  using Projection = ValidProjection<Displacements<D>>;

  explicit Equilibrator(bool uses_regions) : uses_regions_(uses_regions) {}

  void iterate(Body& body, std::span<const ElementId> held, const Progress& progress) override {
    progress.report(0);
    prepared_ = false;
    follow(body, held);
    step(progress);
    last_iterations_ = 1;
    show(body);
  }

  bool solve(Body& body, std::span<const ElementId> held, double tolerance, int max_iterations,
             const Progress& progress) override {
    prepared_ = false;
    follow(body, held);
    bool reached = false;
    last_iterations_ = 0;
    while (last_iterations_ < max_iterations && !reached) {
      progress.report(double(last_iterations_) / max_iterations);
      step(progress);
      ++last_iterations_;
      reached = residual_ <= tolerance;
    }
    show(body);
    return reached;
  }

  void set_threads(int threads) override { threads_ = threads; }
  double residual() const override { return residual_; }
  int iterations() const override { return last_iterations_; }
  bool has_prepared() const override { return prepared_; }
  std::span<const ElementId> moved() const override { return moved_; }
  double largest_step() const override { return largest_step_; }

  std::optional<EquilibriumCertificate> certificate(const Body& body) override {
    if (shown_.mesh != body.stored_mesh().get() || seen_ != body.revisions() || has_moved(body)) {
      return std::nullopt;
    }
    EquilibriumCertificate result;
    result.residual = residual_;
    result.binds = constrained_;
    result.iterations = iterations_;
    read(body, {});
    if (kind_ != EnergyKind::corotated && kind_ != EnergyKind::material) {
      result.gap = relative_gap();
    }
    result.violation = largest_violation();
    return result;
  }

 private:
  // What the body was when it was last seen.

  void follow(Body& body, std::span<const ElementId> held) {
    is_iterate_valid_.reset();
    const Revisions& now = body.revisions();
    const bool is_new = shown_.mesh != body.stored_mesh().get();
    if (is_new) {
      begin(body);
    }
    shown_.body = &body;
    if (uses_regions_ && (is_new || now.softness != seen_.softness)) {
      shown_.regions.set(*mesh_, body.softness(), true);
    }
    if (is_new || now.energy != seen_.energy) {
      take_energy(body);
    }
    if (is_new || now.energy != seen_.energy || now.cuts != seen_.cuts) {
      uses_material() ? note_links() : update_links(body);
    }
    const bool is_same = !is_new && is_same_problem(now, held);
    if (!is_same) {
      prediction_.forget();
      residual_ = 1;  // unknown
    }
    LoopTeam team = loop_team();
    const bool has_moved = read(body, team.loop());
    if (is_new || now.positions != seen_.positions) {
      for (std::size_t e = 0; e < iterate_.size(); ++e) {
        iterate_[e] = vector_of(shown_.positions[e]);
      }
      corotated_.reset();
      newton_.forget();
      material_->forget();
      is_start_ = true;
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
    if (!is_same || has_moved) {
      make_valid(body, team.loop());
    }
    hold_fixed();
    seen_ = body.revisions();
  }

  /// True if only relaxation and moves of this handle have changed the body.
  bool is_same_problem(Revisions now, std::span<const ElementId> held) const {
    now.relaxed = seen_.relaxed;
    return now == seen_ && std::ranges::equal(held, held_);
  }

  /// Other energies than the material's are computed on this thread alone.
  LoopTeam loop_team() const { return LoopTeam(uses_material() ? threads_ : 1, iterate_.size()); }

  void begin(const Body& body) {
    mesh_ = body.stored_mesh();
    shown_.mesh = mesh_.get();
    shown_.positions.resize(mesh_->element_count());
    iterate_.resize(mesh_->element_count());
    energy_ = {};
    newton_.forget();
    fixed_.assign(mesh_->element_count(), 0);
    jump_.assign(mesh_->element_count(), Vector());
    material_ = make_minimum<D>(*mesh_);
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

  /// Returns true if elements have moved by more than rounding since positions were read or written.
  bool read(const Body& body, const SharedLoop& shared) {
    const PositionView positions = body.stored_positions();
    std::atomic<bool> has_moved = false;
    const bool stores_displacements = body.stores_displacements();
    largest_ = shared.largest(mesh_->element_count(), [&](std::size_t first, std::size_t last) {
      double largest = 0;
      bool moves = false;
      for (auto e = static_cast<ElementId>(first); e < last; ++e) {
        for (int k = 0; k < D; ++k) {
          const double at = positions(e, k), from_rest = at - mesh_->rest[std::size_t{e} * D + std::size_t(k)];
          moves = moves || !(std::abs(from_rest - shown_.positions[e][k]) <= tolerance_ / 4);
          shown_.positions[e][k] = from_rest;
          largest = std::max(largest, std::abs(stores_displacements ? from_rest : at));
        }
      }
      if (moves) {
        has_moved = true;
      }
      return largest;
    });
    epsilon_ = body.precision() == Precision::single_precision ? std::numeric_limits<float>::epsilon()
                                                               : std::numeric_limits<double>::epsilon();
    tolerance_ = 4 * epsilon_ * largest_;
    return has_moved;
  }

  Vector rest_vector(LinkId link) const {
    const auto [i, j] = mesh_->links[link];
    return CorotatedEnergy<D>::rest_vector(*mesh_, i, j);
  }

  LinkBlock<double, D> block_of(const Body& body, LinkId link) const {
    if (body.cuts().is_cut(link)) {
      return {};
    }
    const LinkWeights weights = link_weights(*mesh_, body.softness(), link);
    const Vector r = rest_vector(link);
    const double length = r.norm();
    if (!(length > 0) && weights.lateral == 0) {
      return {Vector(), 1};  // its region leaves no room for a deflection, so any stiffness will do
    }
    return {length > 0 ? r / length * std::sqrt(weights.axial / scale_) : Vector(), weights.lateral / scale_};
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
    const EnergyKind kind = energy_in(*mesh_, body.softness().energy);
    const double mean = kind == EnergyKind::material ? 1 : mean_weight(body);
    if (kind_ != kind || !(mean < 10 * scale_ && mean > scale_ / 10)) {
      kind_ = kind;
      scale_ = mean;
      free_.reset();
      penalised_.reset();
      penalised_matrix_.reset();
      end_constraints();
    }
  }

  bool uses_material() const { return kind_ == EnergyKind::material; }

  /// The material has links only in its preconditioner, which follows when it is used.
  void note_links() {
    energy_ = {};
    has_cuts_ = false;
    iterations_ = 0;
  }

  void update_links(const Body& body) {
    if (energy_.size() == 0) {
      energy_ = LinkMatrix<double, D>(mesh_);
      for (ElementId e = 0; e < fixed_.size(); ++e) {
        energy_.set_fixed(e, fixed_[e] != 0);
      }
    }
    std::vector<ElementId> rows;
    bool cut = false;
    for (LinkId link = 0; link < mesh_->link_count(); ++link) {
      const LinkBlock<double, D> block = block_of(body, link);
      const LinkBlock<double, D>& present = energy_.link(link);
      if (!(block.along == present.along) || block.across != present.across) {
        energy_.set_link(link, block);
        if (penalised_matrix_) {
          penalised_matrix_->set_link(link, with_penalty(block));
        }
        if (constrained_ && block.is_zero()) {
          regions_.drop(link);
        }
        rows.insert(rows.end(), {mesh_->links[link][0], mesh_->links[link][1]});
        cut = cut || body.cuts().is_cut(link);
      }
    }
    free_.outdate(rows, cut);
    penalised_.outdate(rows, cut);
    newton_.forget();
    regions_.begin_checks();
    gradient_is_outdated_ = true;
    iterations_ = 0;
  }

  /// Returns the block of the matrix that approximates the curvature of the energy.
  static LinkBlock<double, D> softened(LinkBlock<double, D> block) {
    // Where the lateral part turns with its neighbourhood, it resists large motions little.
    block.across = std::min(block.across, turned_share * std::max(block.across, block.along.squaredNorm()));
    return block;
  }
  LinkBlock<double, D> with_penalty(LinkBlock<double, D> block) const {
    const double all = stiffness_of(block);
    if (kind_ == EnergyKind::corotated) {  // a bound of the curvature, whatever the rotations are
      return {Vector(), (1 + regions_.penalty()) * all};
    }
    block.across += regions_.penalty() * all;
    return block;
  }
  static double stiffness_of(const LinkBlock<double, D>& block) { return block.along.squaredNorm() + block.across; }

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
        if (energy_.size() > 0) {
          energy_.set_fixed(e, fixed[e] != 0);
        }
        if (penalised_matrix_) {
          penalised_matrix_->set_fixed(e, fixed[e] != 0);
        }
        rows.push_back(e);
        const auto neighbours = mesh_->neighbours_of(e);
        rows.insert(rows.end(), neighbours.begin(), neighbours.end());
      }
    }
    fixed_ = std::move(fixed);
    has_fixed_ = false;
    free_.outdate(rows, false);
    penalised_.outdate(rows, false);
    newton_.forget();
    regions_.begin_checks();
    gradient_is_outdated_ = true;
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

  /// Makes the shown state valid if an algorithm left it invalid.
  void make_valid(Body& body, const SharedLoop& shared) {
    if (is_valid(shown_.positions, shared)) {
      return;
    }
    RestoreValidity restore(shown_, search_, std::max(largest_, body.reach().since_rest), held_, epsilon_);
    restore.run(body.pins());
  }

  /// Moves the fixed elements of the iterate to where they are.
  void hold_fixed() {
    for (std::size_t e = 0; e < fixed_.size(); ++e) {
      if (fixed_[e] != 0 && !(iterate_[e] == vector_of(shown_.positions[e]))) {
        if (uses_material()) {
          jump_[e] += vector_of(shown_.positions[e]) - iterate_[e];
          has_jump_ = true;
        }
        iterate_[e] = vector_of(shown_.positions[e]);
        gradient_is_outdated_ = true;
        iterations_ = 0;
      }
    }
  }

  // Iterations.

  void step(const Progress& progress) {
    is_iterate_valid_.reset();
    if (uses_material()) {
      material_step(progress);
      return;
    }
    frees_below_ = iterations_ == 0 ? frees_below : frees_below_;
    constrained_ ? constrained_step(progress) : free_step(progress);
    ++iterations_;
    if (!constrained_ && residual_ < binds_below && !is_valid(iterate_)) {
      begin_constraints();
    }
  }

  void free_step(const Progress& progress) {
    update_free(progress);
    if (kind_ == EnergyKind::corotated) {
      newton_step();
      return;
    }
    if (gradient_is_outdated_ || ++steps_since_gradient_ > steps_per_gradient) {
      energy_of_iterate_ = gradient(iterate_, gradients_.begin());
      gradient_is_outdated_ = false;
      steps_since_gradient_ = 0;
    }
    energy_of_iterate_ -= gradients_.step(energy_, free_, iterate_);
    note_distance(gradients_.distance());
  }

  /// One step of the search for the minimum of the material's energy, then of the forces of regions.
  void material_step(const Progress& progress) {
    prepare_material(progress);
    progress.report(1);
    prepared_ = material_->step(iterate_, threads_, progress) || prepared_;
    energy_of_iterate_ = material_->energy();
    note_distance(material_->distance());
    LoopTeam team = loop_team();
    ++iterations_;
    if (uses_regions_ && (constrained_ || (residual_ < binds_below && !is_iterate_valid(team.loop())))) {
      follow_regions();
    }
  }

  void prepare_material(const Progress& progress) {
    if (!material_->has_begun()) {
      material_->begin(mesh_, progress.part(0, 0.4));
      known_elastic_.reset();
      has_cuts_ = has_fixed_ = false;
    }
    if (const std::uint64_t elastic = shown_.body->revisions().elastic; known_elastic_ != elastic) {
      known_elastic_.reset();
      material_->set_material(shown_.body->elastic(), progress.part(0.4, 0.5));
      known_elastic_ = elastic;
      has_cuts_ = false;
    }
    if (!std::exchange(has_cuts_, true)) {
      material_->set_cuts(shown_.body->cuts());
    }
    for (ElementId e = 0; !has_fixed_ && e < fixed_.size(); ++e) {
      material_->set_fixed(e, fixed_[e] != 0);
    }
    has_fixed_ = true;
    prepared_ = material_->update(progress.part(0.5, 1)) || prepared_;
    if (std::exchange(has_jump_, false)) {
      follow_jump();
    }
    if (std::exchange(is_start_, false) && material_->is_inverted(iterate_, threads_)) {
      try_rest();
    }
  }

  /// Begins where the move of the handle is likely to end: extrapolates the last two frames, unless that inverts cells,
  /// and extends the rest of the motion.
  void follow_jump() {
    LoopTeam team = loop_team();
    for (ElementId e = 0; e < fixed_.size(); ++e) {
      iterate_[e] -= jump_[e];
    }
    const bool has_converged = !constrained_ && residual_ < predicts_below;
    const bool predicts = prediction_.predict(iterate_, jump_, fixed_, has_converged, team.loop());
    extend_jump();
    if (predicts && material_->is_inverted(iterate_, threads_)) {
      iterate_ = prediction_.before();
      for (ElementId e = 0; e < fixed_.size(); ++e) {
        jump_[e] = fixed_[e] != 0 ? vector_of(shown_.positions[e]) - iterate_[e] : Vector();
      }
      extend_jump();
    }
    residual_ = 1;  // unknown
  }

  void extend_jump() {
    material_->extend(jump_, iterate_, threads_);
    for (ElementId e = 0; e < fixed_.size(); ++e) {
      iterate_[e] = fixed_[e] != 0 ? vector_of(shown_.positions[e]) : iterate_[e];  // without rounding
      jump_[e] = {};
    }
  }

  /// Starts at rest, apart from what is fixed, if the energy is less there.
  void try_rest() {
    Vectors rest(iterate_.size(), Vector()), from_rest(iterate_.size(), Vector());
    for (ElementId e = 0; e < fixed_.size(); ++e) {
      if (fixed_[e] != 0) {
        from_rest[e] = iterate_[e];
      }
    }
    material_->extend(from_rest, rest, threads_);
    if (material_->energy_of(rest) < material_->energy_of(iterate_)) {
      iterate_ = std::move(rest);
    }
  }

  /// Finds which regions bind, and moves their forces when the search has come closer than these are to right.
  void follow_regions() {
    const double distance = residual_;
    const auto square = [&] { return 2 * std::max(0.0, energy_of_iterate_) + unseen_energy(); };
    const bool moves = constrained_ && distance * distance * square() < region_error_;
    const auto update = material_->regions().update(links(), iterate_, moves);
    region_error_ = update.error;
    constrained_ = !material_->regions().is_empty();
    if (moves || !update.changed.empty()) {
      material_->follow_regions(update.changed);
    }
    residual_ = std::max(distance, std::sqrt(update.error / square()));
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

  void update_free(const Progress& progress) {
    const bool is_built = kind_ == EnergyKind::corotated ? free_.update(mesh_, energy_, softened, progress)
                                                         : free_.update(mesh_, energy_, std::identity(), progress);
    prepared_ = prepared_ || is_built;
  }

  void newton_step() {
    if (gradient_is_outdated_) {
      energy_of_iterate_ = gradient(iterate_, force_);
      gradient_is_outdated_ = false;
    }
    const auto evaluate = [&](const Vectors& at, Vectors& force) { return gradient(at, force); };
    const bool lowered = newton_.step(evaluate, free_, iterate_, energy_of_iterate_, force_);
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
    rest.assign(at.size(), Vector());
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
    regions_.begin(mesh_->link_count(), links(), iterate_);
    residual_ = 1;  // of the free minimum, it says nothing now
    if (!penalised_matrix_) {
      penalise();
    }
  }

  /// Makes the matrix with the present penalty.
  void penalise() {
    penalised_matrix_.emplace(energy_);
    for (LinkId link = 0; link < mesh_->link_count(); ++link) {
      penalised_matrix_->set_link(link, with_penalty(energy_.link(link)));
    }
    if (kind_ != EnergyKind::corotated) {
      penalised_.reset();
    }
  }

  /// For the corotated energy, the penalty is a factor of the whole matrix. It is left out: a factor of the
  /// preconditioner does not matter, and all levels stay when the penalty changes.
  void update_penalised(const Progress& progress) {
    const auto without_penalty = [](const LinkBlock<double, D>& block) {
      return LinkBlock<double, D>{Vector(), stiffness_of(block)};
    };
    const bool is_built = kind_ == EnergyKind::corotated
                              ? penalised_.update(mesh_, energy_, without_penalty, progress)
                              : penalised_.update(mesh_, *penalised_matrix_, std::identity(), progress);
    prepared_ = prepared_ || is_built;
  }

  void end_constraints() {
    material_->follow_regions(material_->regions().clear());
    constrained_ = false;
    gradient_is_outdated_ = true;
  }

  /// Returns a function that calls visit(link, i, j, region, stiffness) for each link that counts, with i < j and the
  /// region of j about i.
  auto links() const {
    return [this](auto visit) {
      for (ElementId i = 0; i < mesh_->element_count(); ++i) {
        shown_.for_each_neighbour(i, [&](ElementId j, EntryId entry) {
          if (j > i && (fixed_[i] == 0 || fixed_[j] == 0)) {
            const LinkId link = mesh_->entry_link[entry];
            visit(link, i, j, shown_.regions[entry],
                  uses_material() ? material_->stiffness(link) : stiffness_of(energy_.link(link)));
          }
        });
      }
    };
  }

  /// One step of the method of multipliers: an approximate minimum of the energy with springs to the links' copies,
  /// then copies and multipliers.
  void constrained_step(const Progress& progress) {
    update_penalised(progress);
    Vectors& rest = gradients_.begin();
    energy_of_iterate_ = gradient(iterate_, rest);
    regions_.add_forces(links(), iterate_, rest);
    energy_.clear_fixed(rest);
    gradients_.step(*penalised_matrix_, penalised_, iterate_);
    gradient_is_outdated_ = true;
    const auto step = regions_.step(links(), iterate_);
    residual_ = std::sqrt(std::max(step.outside, step.stepped) / (step.size + unseen_energy()));
    if (!step.forced && residual_ < frees_below_ && is_valid(iterate_)) {
      end_constraints();
      frees_below_ /=
          10;  // if regions bind after all, the forces were 0 only on their way: that must not repeat forever
    } else if (regions_.adapt(step)) {
      penalise();
    }
  }

  // What the user sees.

  Projection projection() const { return Projection(shown_, fixed_, tolerance_); }
  template <class Positions>
  bool is_valid(const Positions& positions, const SharedLoop& shared = {}) const {
    return !uses_regions_ || projection().is_valid(positions, shared);
  }

  /// Checks the iterate once after each step.
  bool is_iterate_valid(const SharedLoop& shared) {
    if (!is_iterate_valid_) {
      is_iterate_valid_ = is_valid(iterate_, shared);
    }
    return *is_iterate_valid_;
  }

  void show(Body& body) {
    LoopTeam team = loop_team();
    const SharedLoop shared = team.loop();
    if (!is_iterate_valid(shared)) {
      projection().run(shown_.positions, iterate_);
    } else {
      shared.run(iterate_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t e = first; e < last; ++e) {
          for (int k = 0; k < D; ++k) {
            shown_.positions[e][k] = fixed_[e] != 0 ? shown_.positions[e][k] : iterate_[e][k];
          }
        }
      });
    }
    write(body, shared);
  }

  void write(Body& body, const SharedLoop& shared) {
    steps_.assign(shown_.positions.size(), 0);
    body.with_view([&]<class View>(const View& view) {
      if constexpr (View::Dimension == D) {
        shared.run(steps_.size(), [&](std::size_t first, std::size_t last) {
          for (auto e = static_cast<ElementId>(first); e < last; ++e) {
            const auto before = view.positions[e];
            for (int k = 0; k < D; ++k) {
              view.set_position(e, k, mesh_->rest[std::size_t{e} * D + std::size_t(k)] + shown_.positions[e][k]);
              const double step = double(view.positions[e][k]) - double(before[k]);
              steps_[e] += step * step;
            }
          }
        });
      }
    });
    note_moved();
    if (!moved_.empty()) {
      body.note_relaxation();
      seen_ = body.revisions();
    }
  }

  void note_moved() {
    moved_.resize(steps_.size());
    std::size_t count = 0;
    largest_step_ = 0;
    for (ElementId e = 0; e < steps_.size(); ++e) {
      if (steps_[e] > 0) {
        moved_[count++] = e;
        largest_step_ = std::max(largest_step_, steps_[e]);
      }
    }
    moved_.resize(count);
    largest_step_ = std::sqrt(largest_step_);
  }

  /// Returns true if elements have moved since the last call of write.
  bool has_moved(const Body& body) const {
    const PositionView positions = body.stored_positions();
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      for (int k = 0; k < D; ++k) {
        const double at = positions(e, k), rest = mesh_->rest[std::size_t{e} * D + std::size_t(k)];
        if (!(std::abs(at - rest - shown_.positions[e][k]) <= tolerance_ + 4 * epsilon_ * std::abs(at))) {
          return true;
        }
      }
    }
    return false;
  }

  // The certificate.

  /// Returns by how much the energy of the shown state exceeds a lower bound of that of all valid states (the value of
  /// Lagrange's dual function), relative to the energy.
  double relative_gap() {
    const Vectors& at = iterate_;
    Vectors rest(at.size(), Vector());
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
      links()([&](LinkId link, ElementId i, ElementId j, const Region<double, D>& region, double stiffness) {
        const Vector force = regions_.force(link, stiffness);
        bound += force.dot(at[j] - at[i]);
        for (int k = 0; k < D; ++k) {
          bound -= force[k] > 0 ? force[k] * region.high[k] : force[k] * region.low[k];
        }
        rest[i] += force;
        rest[j] -= force;
      });
    }
    energy_.clear_fixed(rest);
    update_free({});
    Vectors step;
    free_.apply(rest, step);
    bound -= dot(rest, step) / 2;
    return energy > 0 ? std::max(0.0, energy - bound) / energy : 0;
  }

  double largest_violation() const {
    double largest = 0;
    links()([&](LinkId link, ElementId i, ElementId j, const Region<double, D>& region, double) {
      const Vector apart = vector_of(shown_.positions[j]) - vector_of(shown_.positions[i]);
      const double outside = (apart - regions_.clamped_to(region, apart)).norm(), length = rest_vector(link).norm();
      largest = std::max(largest, outside / (length > 0 ? length : mesh_->mean_link_length));
    });
    return largest;
  }

  const bool uses_regions_;
  int threads_ = 1;
  bool prepared_ = false;
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

  LinkMatrix<double, D> energy_;  // of links; empty with that of the material
  Preconditioner<D> free_;
  std::optional<LinkMatrix<double, D>> penalised_matrix_;
  Preconditioner<D> penalised_;

  Vectors iterate_;  // displacements
  std::optional<bool> is_iterate_valid_;
  ConjugateGradients<D> gradients_;
  CorotatedEnergy<D> corotated_;
  QuasiNewton<D> newton_;
  Vectors force_;                     // the negative gradient, for the quasi-Newton method
  bool gradient_is_outdated_ = true;  // the gradient must be computed anew
  int steps_since_gradient_ = 0;
  double energy_of_iterate_ = 0;
  double residual_ = 0;
  double frees_below_ = frees_below;  // falls each time in one problem
  int iterations_ = 0;
  int last_iterations_ = 0;  // of the last call

  std::unique_ptr<EnergyMinimum<D>> material_;
  std::optional<std::uint64_t> known_elastic_;  // revision of the body's elasticity that it knows
  bool has_cuts_ = false, has_fixed_ = false;   // it knows the body's
  bool is_start_ = true;                        // the iterate was set from outside
  Vectors jump_;                                // by which fixed elements have moved since the last step
  bool has_jump_ = false;
  LinearPrediction<D> prediction_;
  double region_error_ = 0;  // how far the forces of regions were from right, see RegionPenalties

  bool constrained_ = false;  // valid regions bind
  RegionMultipliers<D> regions_;

  std::vector<double> steps_;  // of each element: its last step, squared
  std::vector<ElementId> moved_;
  double largest_step_ = 0;
};

}  // namespace

std::unique_ptr<EquilibriumSolver> EquilibriumSolver::make(int space_dimension, bool uses_regions) {
  switch (space_dimension) {
    case 1:
      return std::make_unique<Equilibrator<1>>(uses_regions);
    case 2:
      return std::make_unique<Equilibrator<2>>(uses_regions);
    default:
      return std::make_unique<Equilibrator<3>>(uses_regions);
  }
}

}  // namespace chainmail

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/body.h"
#include "body/method.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/relaxation.h"
#include "mesh/progress.h"
#include "mesh/split.h"
#include "solver/algorithms.h"

namespace chainmail {

class LocalRelaxation;

/// True if a body stores displacements from rest for an algorithm: for some always, and for all in single precision if
/// the object lies far from the origin, where positions are too coarse.
bool stores_displacements(const AlgorithmInfo& algorithm, const Body& body);

/// Options of relaxation that runs at once.
struct RelaxOptions {
  /// Fraction of its displacement that an element moves per sweep: above 0, to 1.
  double step = parameters::relax_step.default_value;
  RelaxationScheme scheme = RelaxationScheme::mean;
  /// With the scheme `equilibrium`: the residual at which it ends, see EquilibriumCertificate; 0 to 1. With 0, all
  /// iterations run.
  double until = parameters::relax_until.default_value;
  /// With the scheme `equilibrium`: fine only where needed, see set_relaxation().
  bool local = false;
};

/// Deforms one object with one algorithm: a body, the method that answers its moves, and relaxation. The algorithm may
/// change between passes and continues from the current positions. It is the only class that changes an object: window,
/// command line, Python and comparisons use it. One thread at a time may use it.
class Deformer {
 public:
  /// Takes an object at rest. Throws Error if the algorithm does not work on the mesh.
  Deformer(MeshPointer mesh, Algorithm algorithm, Precision precision = Precision::double_precision);

  /// Returns a deformer of a copy of the object, with the same algorithm and handle. It has none of what the method and
  /// relaxation keep.
  Deformer copy() const { return {body_, algorithm_, last_handle_, held_}; }

  /// The object. It may be changed between passes; the functions below also check their arguments, and wake what a
  /// change concerns.
  Body& body() { return body_; }
  const Body& body() const { return body_; }
  Algorithm algorithm() const { return algorithm_.algorithm; }

  /// Cut or restore links (ids), pin or release elements (ids), and wake these elements for relaxation. They throw
  /// Error for an id that does not exist; nothing has changed then.
  void cut(std::span<const LinkId> links);
  void uncut(std::span<const LinkId> links);
  void pin(std::span<const ElementId> elements);
  void unpin(std::span<const ElementId> elements);
  /// Sets the softness. If it changes the energy, wakes all elements for relaxation. Throws Error as check() does.
  void set_softness(const Softness& softness);

  // Set all positions, and release the handle: its elements are elsewhere now.
  /// Sets positions: x, y and z for each element (mesh units). Throws Error as coordinates_of() does.
  void set_positions(std::span<const double> positions);
  /// Moves all elements to rest.
  void reset();
  /// Restores a snapshot. Throws Error if it is not of this mesh and precision.
  void restore(const Snapshot& snapshot);
  /// Restores an object of this mesh. Outside the blocks `changed`, the positions must be as in the snapshot.
  void restore(const ObjectState& object, const Snapshot& positions, const ElementBlocks& changed);

  // Replace the object. Options of elasticity, the scheme of relaxation, progress and threads stay.
  /// Puts another object at rest in its place. Natural Queue runs if the algorithm does not work on its mesh. If memory
  /// runs out, nothing has changed.
  void replace(const ObjectState& object, Algorithm algorithm);
  /// Splits cells or faces: positions, cuts, pins and softness go over to the new elements and links, and so does the
  /// last handle unless it is pinned now. Wakes the new elements. `positions` are the present ones; returns those after
  /// it. Throws Error if the object does not have the mesh before the split; nothing has changed then.
  Snapshot split(const SplitPointer& split, const Snapshot& positions);

  /// Throws Error if the algorithm does not work on the mesh; nothing has changed then.
  void set_algorithm(Algorithm algorithm);
  /// Sets the progress of long preparations and solutions. A cancelled pass throws Cancelled, and nothing has moved.
  void set_progress(const Progress& progress) { progress_ = progress; }
  /// Sets the number of threads that a pass or an iteration may use, at least 1, which is the default. A pass gets
  /// fewer while other passes run. No result depends on it.
  void set_threads(int threads);

  /// Moves a handle to a target and propagates: one pass. The handle gets the pose that was reached. `trace`, if given,
  /// receives every processed candidate. Throws Error if an element of the handle is pinned, if the target is not a
  /// finite number of the precision, and if there is no answer; nothing has moved then.
  PassCount move(Handle& handle, const Pose& target, Trace* trace = nullptr);
  /// The same for a single element and its target (mesh units, on the axes that exist).
  PassCount move(ElementId element, const Point& target, Trace* trace = nullptr);
  /// Prepares the first move of an element, for idle time: it will be as fast as a later one if it moves the whole
  /// object. Changes no result. Throws Cancelled; a later call then starts again.
  void prepare(ElementId element);
  /// Prepares the first iteration that is fine only where needed, for idle time: see set_relaxation(). Changes no
  /// result. Returns true if there was something to do. Throws Cancelled; a later call then starts again.
  bool prepare_relaxation();
  /// True if the next slice follows the handle, fine only where needed, or writes what the last one left out.
  bool follows_next(std::span<const ElementId> held) const { return may_follow(held) || follows_; }
  /// True if slices for the whole object, which come when the handle rests, would first have to prepare that. One that
  /// is cancelled then leaves no trace.
  bool lacks_preparation() const;
  /// Reason why the last pass did not reach its target or did not converge. Usually empty.
  std::string remark() const { return method_ ? method_->remark() : std::string(); }
  /// The elements that the last pass moved, in order of update, without the handle.
  std::span<const ElementId> moved() const { return moved_; }

  /// Holds elements (ids, ascending) in place while relaxation runs, until release() or the next handle: so does a move
  /// with the elements of its handle.
  void hold(std::span<const ElementId> elements) { held_.assign(elements.begin(), elements.end()); }
  void release() { held_.clear(); }
  std::span<const ElementId> held() const { return held_; }
  /// The elements of the last handle, about which relaxation begins; none since the positions were set.
  std::span<const ElementId> last_handle() const { return last_handle_; }
  /// Call this with the elements of another handle, or with none, after positions were set.
  void set_last_handle(std::span<const ElementId> elements) { last_handle_.assign(elements.begin(), elements.end()); }

  /// What relaxation that runs at once has done.
  struct Relaxed {
    int sweeps = 0;                       // or iterations, with the scheme `equilibrium`
    std::optional<double> residual = {};  // after iterations for the whole object
    std::optional<double> estimate = {};  // after those that are fine only where needed, see RelaxationResult
    std::size_t nodes = 0;
  };
  /// Runs sweeps of relaxation about the elements of the last move, until nothing moves or `most` have run. The scheme
  /// `equilibrium` runs iterations for the whole object instead, until the residual is small, and moves the elements
  /// once, at the end. What is held, and pins, stay, but `equilibrium` moves held elements only as far as the pins
  /// allow.
  /// Each element stays in the valid regions of its neighbours. Does nothing for methods of elasticity, whose answers
  /// are equilibria. `after_slice`, if given, is called after elements have moved, see relaxed(). Throws Error for
  /// options out of their range or a number below 0, and if pins contradict each other and the scheme is `equilibrium`;
  /// and Cancelled, which keeps the positions that sweeps have reached.
  Relaxed relax(int most, const RelaxOptions& options = {}, const std::function<void()>& after_slice = {});

  // Relaxation in slices, for idle time.

  /// Elements that a slice may visit: about 2 ms, so that nobody waits longer for its end.
  static constexpr std::uint64_t elements_per_slice = 20'000;

  /// Makes these elements and their neighbours active: relaxation will visit them. The scheme `equilibrium` then visits
  /// all elements.
  void wake(std::span<const ElementId> elements);
  void wake_all();
  /// Makes all elements inactive.
  void sleep();
  /// Drops all that relaxation has kept, so that it goes on as a new solver would. Makes all elements inactive.
  void forget_relaxation();
  /// With `local`, the scheme `equilibrium` is fine only where needed, after the handle has moved or links were cut,
  /// where LocalRelaxation is for the body and something is held. Slices write only what is fine or on the surface, the
  /// first one after that writes all, and later ones iterate for the whole object.
  void set_relaxation(RelaxationScheme scheme, bool local = false);
  RelaxationScheme relaxation() const { return scheme_; }
  bool relaxes_locally() const { return is_local_; }
  /// Writes what slices that are fine only where needed have left out. Changes nothing for later slices. Returns true
  /// if it wrote elements, see relaxed().
  bool complete_relaxation();
  /// Relaxes with a step in (0, 1] until a sweep ends or `budget` elements were visited. The scheme `equilibrium` runs
  /// one iteration; it ignores step and budget, and throws Error if pins contradict each other, and Cancelled. The
  /// elements of `held` (ascending) stay. If nothing is active, `visited` is 0 and the sweep has ended.
  RelaxationResult relax_slice(double step, std::uint64_t budget, std::span<const ElementId> held);
  /// The elements that the last slice with the present scheme moved, once per move.
  std::span<const ElementId> relaxed() const;
  /// Returns how close the object is to the equilibrium; none if the scheme `equilibrium` has not relaxed it as it is.
  std::optional<EquilibriumCertificate> certificate();

 private:
  Deformer(Body body, AlgorithmInfo algorithm, std::vector<ElementId> last_handle, std::vector<ElementId> held)
      : body_(std::move(body)),
        algorithm_(std::move(algorithm)),
        last_handle_(std::move(last_handle)),
        held_(std::move(held)) {}

  Method& method();
  void forget_handle();
  template <class Pass>
  PassCount run(Pass pass);
  void store_for(const AlgorithmInfo& algorithm);
  PassCount move_along_axes(Handle& handle, const Pose& target, Trace* trace);
  template <class Solve>
  void try_equilibrate(Solve solve);
  template <class Solve>
  RelaxationResult equilibrate(std::span<const ElementId> held, Solve solve);
  bool may_follow(std::span<const ElementId> held) const;
  bool build_local();
  RelaxationResult follow(std::span<const ElementId> held);
  RelaxationResult end_following();
  void forget_local();
  std::uint64_t sweep(double step, const Progress& progress, const std::function<void()>& after_slice);
  void wake_ends(std::span<const LinkId> links);
  void note_handle(const Handle& handle);

  Body body_;
  AlgorithmInfo algorithm_;
  std::unique_ptr<Method> method_;  // of the algorithm, made by its first pass
  std::vector<ElementId> moved_;
  std::optional<Handle> single_;  // of the last move of a single element
  std::vector<ElementId> last_handle_, held_;
  RelaxationScheme scheme_ = RelaxationScheme::mean;
  Relaxation relaxation_;                           // the schemes that sweep
  std::unique_ptr<EquilibriumSolver> equilibrium_;  // made by the first iteration
  bool is_local_ = false;
  std::shared_ptr<LocalRelaxation> local_;  // not shared: its type is not complete here
  RelaxationResult local_slice_;            // the last one that followed the handle
  int local_iterations_ = 0;                // of it
  bool has_changed_ = false;                // the handle has moved, or links were cut, since the last iteration
  bool follows_ = false;                    // the last slice followed the handle
  bool is_incomplete_ = false;              // it left elements out
  bool was_local_ = false;                  // the last slice, or completion, was that of `local_`
  /// Revision of the positions when the object was last woken; none: the scheme `equilibrium` sleeps.
  std::optional<std::uint64_t> awake_at_;
  Progress progress_;
  int threads_ = 1;
};

}  // namespace chainmail

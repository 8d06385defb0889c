#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "body/body.h"
#include "body/method.h"
#include "body/trace.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/relaxation.h"
#include "mesh/progress.h"
#include "solver/algorithms.h"

namespace chainmail {

/// True if a body stores displacements from rest for an algorithm: for some always, and for all in single precision if
/// the object lies far from the origin, where positions are too coarse.
bool stores_displacements(const AlgorithmInfo& algorithm, const Body& body);

/// Deforms one object with one algorithm: a body, the method that answers its moves, and relaxation. The algorithm may
/// change between passes and continues from the current positions.
class Solver {
 public:
  /// Throws Error if the algorithm does not work on the mesh.
  Solver(MeshPointer mesh, Algorithm algorithm, Precision precision);

  /// The object: its cuts, pins, softness and positions may be changed between passes.
  Body& body() { return body_; }
  const Body& body() const { return body_; }

  /// Throws Error if the algorithm does not work on the mesh; nothing has changed then.
  void set_algorithm(Algorithm algorithm);
  /// Sets the progress of long preparations and solutions. A cancelled pass throws Cancelled, and nothing has moved.
  void set_progress(const Progress& progress) { progress_ = progress; }
  /// Sets the number of threads that a pass or an iteration may use, at least 1, which is the default. A pass gets
  /// fewer while other passes run. No result depends on it.
  void set_threads(int threads) { threads_ = threads; }

  /// Moves a handle to a target and propagates: one pass. The handle gets the pose that was reached. `trace`, if given,
  /// receives every processed candidate. Throws Error if an element of the handle is pinned, if the target is not a
  /// finite number of the precision, and if there is no answer; nothing has moved then.
  PassCount move(Handle& handle, const Pose& target, Trace* trace = nullptr);
  /// The same for a single element and its target (mesh units, on the axes that exist).
  PassCount move(ElementId element, const Point& target, Trace* trace = nullptr);
  /// Prepares the first move of an element, for idle time: it will be as fast as a later one if it moves the whole
  /// object. Changes no result. Throws Cancelled; a later call then starts again.
  void prepare(ElementId element);
  /// Reason why the last pass did not reach its target or did not converge. Usually empty.
  std::string remark() const { return method_ ? method_->remark() : std::string(); }
  /// The elements that the last pass moved, in order of update, without the handle.
  std::span<const ElementId> moved() const { return moved_; }

  /// Makes these elements and their neighbours active: relaxation will visit them. The scheme `equilibrium` then visits
  /// all elements.
  void wake(std::span<const ElementId> elements);
  void wake_all();
  /// Makes all elements inactive.
  void sleep();
  /// Drops all that relaxation has kept, so that it goes on as a new solver would. Makes all elements inactive.
  void forget_relaxation();
  void set_relaxation(RelaxationScheme scheme);
  RelaxationScheme relaxation() const { return scheme_; }
  /// Relaxes with a step in (0, 1] until a sweep ends or `budget` elements were visited. The scheme `equilibrium` runs
  /// one iteration; it ignores step and budget, and throws Error if pins contradict each other, and Cancelled. The
  /// elements of `held` (ascending) stay. If nothing is active, `visited` is 0 and the sweep has ended.
  RelaxationResult relax(double step, std::uint64_t budget, std::span<const ElementId> held);
  /// Runs iterations of the scheme `equilibrium` until the residual is at most `tolerance`, but at most
  /// `max_iterations`. Moves the elements once, at the end. Throws Error if pins contradict each other, and Cancelled;
  /// nothing has moved then.
  RelaxationResult solve(double tolerance, int max_iterations, std::span<const ElementId> held,
                         const Progress& progress);
  /// The elements that the last call of relax or solve moved, once per move.
  std::span<const ElementId> relaxed() const;
  /// Returns how close the object is to the equilibrium; none if the scheme `equilibrium` has not relaxed it as it is.
  std::optional<EquilibriumCertificate> certificate();

 private:
  Method& method();
  template <class Pass>
  PassCount run(Pass pass);
  void store_for(const AlgorithmInfo& algorithm);
  PassCount move_along_axes(Handle& handle, const Pose& target, Trace* trace);
  template <class Solve>
  RelaxationResult equilibrate(Solve solve);

  Body body_;
  AlgorithmInfo algorithm_;
  std::unique_ptr<Method> method_;  // of the algorithm, made by its first pass
  std::vector<ElementId> moved_;
  std::optional<Handle> single_;  // of the last move of a single element
  RelaxationScheme scheme_ = RelaxationScheme::mean;
  Relaxation relaxation_;                           // the schemes that sweep
  std::unique_ptr<EquilibriumSolver> equilibrium_;  // made by the first iteration
  /// Revision of the positions when the object was last woken; none: the scheme `equilibrium` sleeps.
  std::optional<std::uint64_t> awake_at_;
  Progress progress_;
  int threads_ = 1;
};

/// Throws Error if the algorithm does not work on the mesh.
std::unique_ptr<Solver> make_solver(const MeshPointer& mesh, Algorithm algorithm, Precision precision);

}  // namespace chainmail

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/element_blocks.h"
#include "mesh/progress.h"
#include "solve/algorithms.h"
#include "solve/relaxation_result.h"
#include "solve/snapshot.h"
#include "solve/softness.h"
#include "solve/trace.h"

namespace chainmail {

enum class Precision { single_precision, double_precision };

/// Largest coordinate that a solver stores (mesh units), so that sums of a few of them are finite.
double position_limit(Precision precision);

/// Throws Error, with the reason, if a snapshot does not fit the mesh or has coordinates beyond position_limit.
void check(const Snapshot& snapshot, const Mesh& mesh, Precision precision);

/// The current positions of all elements, without a copy. Valid until the solver changes.
class PositionView {
 public:
  /// If `from_rest` is given, the elements hold displacements from the rest positions of this mesh.
  PositionView(const void* first, std::size_t stride, Precision precision, const Mesh* from_rest = nullptr)
      : first_(static_cast<const std::byte*>(first)), stride_(stride), precision_(precision), from_rest_(from_rest) {}

  /// Returns coordinate k (of the axes that exist) of an element, in mesh units.
  double operator()(ElementId element, int k) const {
    const double at = held(element, k);
    return from_rest_ == nullptr ? at : rest(element, k) + at;
  }

  /// Returns the distance from one element to another along axis k (mesh units). Displacements keep their digits,
  /// however far the object is from the origin or from rest.
  double between(ElementId from, ElementId to, int k) const {
    const double apart = held(to, k) - held(from, k);
    return from_rest_ == nullptr ? apart : rest(to, k) - rest(from, k) + apart;
  }

 private:
  double held(ElementId element, int k) const {
    const std::byte* at = first_ + element * stride_;
    return precision_ == Precision::single_precision ? double(reinterpret_cast<const float*>(at)[k])
                                                     : reinterpret_cast<const double*>(at)[k];
  }
  double rest(ElementId element, int k) const {
    return from_rest_->rest[std::size_t{element} * static_cast<std::size_t>(from_rest_->space_dimension) + k];
  }

  const std::byte* first_;
  std::size_t stride_;
  Precision precision_;
  const Mesh* from_rest_;
};

/// Returns the position of an element with all three coordinates (mesh units).
Point point_of(const Mesh& mesh, const PositionView& positions, ElementId element);

/// Deforms one object with one algorithm. make_solver chooses the scalar and the space dimension at run time. The
/// algorithm may change between passes and continues from the current positions.
class Solver {
 public:
  virtual ~Solver() = default;

  /// Throws Error if the algorithm does not work on the mesh; nothing has changed then.
  virtual void set_algorithm(Algorithm algorithm) = 0;
  virtual void set_softness(const Softness& softness) = 0;
  /// Sets the options of the methods of elasticity. The ChainMail family ignores them.
  virtual void set_elastic(const ElasticOptions& options) = 0;
  /// Sets the progress of long preparations and solutions of these methods. A cancelled pass throws Cancelled, and
  /// nothing has moved.
  virtual void set_progress(const Progress& progress) = 0;
  virtual void cut(std::span<const LinkId> links) = 0;
  virtual void uncut(std::span<const LinkId> links) = 0;
  /// Pins elements at their current positions. To move a pinned element is an error.
  virtual void pin(std::span<const ElementId> elements) = 0;
  virtual void unpin(std::span<const ElementId> elements) = 0;
  /// The pinned elements, ascending.
  virtual std::span<const ElementId> pins() const = 0;
  /// Moves all elements to rest. Cuts, pins and softness stay.
  virtual void reset() = 0;
  /// The same as reset(), but faster. No element outside these blocks may be away from rest.
  virtual void reset(const ElementBlocks& away) = 0;

  /// Moves an element to a target (mesh units, on the axes that exist) and propagates: one pass. `trace`, if given,
  /// receives every processed candidate. Throws Error if the element is pinned, if the target is not a finite number of
  /// the scalar, and, with Exact ChainMail, if pins contradict each other; nothing has moved then.
  virtual PassCount move(ElementId element, const Point& target, Trace* trace = nullptr) = 0;
  /// Reason why the last pass did not reach its target or did not converge. Usually empty.
  virtual const std::string& remark() const = 0;
  /// Returns the control points of free-form deformation, as in ElasticSolver; empty for other algorithms.
  virtual std::span<const double> control_points() = 0;
  /// Moves a control point to a target (mesh units): one pass without a grabbed element. Throws Error if the point does
  /// not exist.
  virtual PassCount move_control_point(std::size_t point, const Point& target) = 0;
  /// The elements that the last pass moved, in order of update, without the grabbed one.
  virtual std::span<const ElementId> moved() const = 0;

  /// Makes these elements and their neighbours active: relaxation will visit them.
  virtual void wake(std::span<const ElementId> elements) = 0;
  virtual void wake_all() = 0;
  virtual void set_relaxation(RelaxationScheme scheme) = 0;
  /// Relaxes with a step in (0, 1] until a sweep ends or `budget` elements were visited. `held` stays. If nothing is
  /// active, `visited` is 0 and the sweep has ended.
  virtual RelaxationResult relax(double step, std::uint64_t budget, std::optional<ElementId> held) = 0;
  /// The elements that the last call of relax moved, once per move.
  virtual std::span<const ElementId> relaxed() const = 0;
  /// Makes all elements inactive.
  virtual void sleep() = 0;

  virtual const Cuts& cuts() const = 0;
  virtual PositionView positions() const = 0;
  /// Writes the coordinates of the elements from `first` on into `out`, space_dimension per element.
  virtual void copy_positions(ElementId first, std::span<float> out) const = 0;
  virtual void copy_positions(ElementId first, std::span<double> out) const = 0;
  /// Writes the coordinates of all elements (element_count x space_dimension).
  void copy_positions(std::span<float> out) const { copy_positions(0, out); }
  void copy_positions(std::span<double> out) const { copy_positions(0, out); }
  /// Sets all coordinates, in the order of copy_positions.
  virtual void set_positions(std::span<const double> in) = 0;
  /// Returns the positions of these blocks. No other element may be away from rest.
  virtual Snapshot snapshot(const ElementBlocks& away) const = 0;
  /// Restores a snapshot: elements that it does not give move to rest. No element outside `away` may be away from rest
  /// now. The snapshot must have passed check().
  virtual void restore(const Snapshot& snapshot, const ElementBlocks& away) = 0;
  /// Updates these blocks of `kept`. No element outside `away` may be away from rest.
  virtual void keep_positions(const ElementBlocks& blocks, const ElementBlocks& away, PositionBlocks& kept) const = 0;
  /// Restores these blocks. All others must be as they were saved.
  virtual void restore(const PositionBlocks& kept, const ElementBlocks& blocks) = 0;
};

/// Throws Error if the algorithm does not work on the mesh.
std::unique_ptr<Solver> make_solver(const MeshPointer& mesh, Algorithm algorithm, Precision precision);

}  // namespace chainmail

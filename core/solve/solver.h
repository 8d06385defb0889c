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
#include "solve/snapshot.h"
#include "solve/relaxation_result.h"
#include "solve/softness.h"
#include "solve/trace.h"

namespace chainmail {

enum class Precision { single_precision, double_precision };

/// Held positions stay within this (mesh units), so that sums of a few of them are finite.
double position_limit(Precision precision);

/// Throws Error, saying why, where a placement is none of this mesh, or holds numbers beyond that limit.
void check(const Snapshot& placement, const Mesh& mesh, Precision precision);

/// The current positions of all elements, read in place; valid until the solver is next changed.
class PositionView {
 public:
  /// Where `from_rest` is given, the elements hold displacements from the rest positions of this mesh.
  PositionView(const void* first, std::size_t stride, Precision precision, const Mesh* from_rest = nullptr)
      : first_(static_cast<const std::byte*>(first)), stride_(stride), precision_(precision), from_rest_(from_rest) {}

  /// Coordinate k (of those the scene carries) of an element, in mesh units.
  double operator()(ElementId element, int k) const {
    const double at = held(element, k);
    return from_rest_ == nullptr ? at : rest(element, k) + at;
  }

  /// From one element to another along axis k (mesh units). Where displacements are held, it keeps their
  /// digits, however far the object is from the origin or from rest.
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

/// Where an element stands, with all three coordinates (mesh units).
Point point_of(const Mesh& mesh, const PositionView& positions, ElementId element);

/// Moves one object by one algorithm. The scalar and the space dimension are chosen once, at run time,
/// by make_solver; the algorithm may change between passes and finds the positions as they are.
class Solver {
 public:
  virtual ~Solver() = default;

  /// Throws Error where the algorithm does not work on the mesh; nothing has changed then.
  virtual void set_algorithm(Algorithm algorithm) = 0;
  virtual void set_softness(const Softness& softness) = 0;
  /// What the methods of elasticity go by; the ChainMail family does not look at it.
  virtual void set_elastic(const ElasticOptions& options) = 0;
  /// What these methods prepare and solve may take long: they report here, and a pass that is cancelled leaves by
  /// Cancelled, with nothing moved.
  virtual void set_progress(const Progress& progress) = 0;
  virtual void cut(std::span<const LinkId> links) = 0;
  virtual void uncut(std::span<const LinkId> links) = 0;
  /// Pinned elements stay where they are; to move one is an error.
  virtual void pin(std::span<const ElementId> elements) = 0;
  virtual void unpin(std::span<const ElementId> elements) = 0;
  /// The pinned elements, ascending.
  virtual std::span<const ElementId> pins() const = 0;
  /// Back to the rest positions; cuts, pins and softness stay.
  virtual void reset() = 0;
  /// The same, where no element outside these blocks stands away from rest.
  virtual void reset(const ElementBlocks& away) = 0;

  /// Sets an element to a target (mesh units; the carried axes count) and propagates: one pass.
  /// `trace`, where given, receives every candidate that was processed. Throws Error where the element is
  /// pinned, where the target is not a finite number of the solver's scalar, and, with Exact ChainMail,
  /// where pins contradict each other; nothing has moved then.
  virtual PassCount move(ElementId element, const Point& target, Trace* trace = nullptr) = 0;
  /// Where the last pass did not end where it should have: why. Empty mostly.
  virtual const std::string& remark() const = 0;
  /// The control points of free-form deformation, as ElasticSolver has them; none by other algorithms.
  virtual std::span<const double> control_points() = 0;
  /// Puts one of them somewhere (mesh units): a pass, about no element. Throws Error where there is no such point.
  virtual PassCount move_control_point(std::size_t point, const Point& target) = 0;
  /// The elements that the last pass moved, in order of update, without the grabbed one.
  virtual std::span<const ElementId> moved() const = 0;

  /// Makes these elements and their neighbours active: relaxation will look at them.
  virtual void wake(std::span<const ElementId> elements) = 0;
  virtual void wake_all() = 0;
  virtual void set_relaxation(RelaxationScheme scheme) = 0;
  /// Goes on relaxing with a step in (0, 1] until a sweep ends or `budget` elements were visited;
  /// `held` stays. Sleeps where nothing is active (then visited is 0 and the sweep has ended).
  virtual RelaxationResult relax(double step, std::uint64_t budget, std::optional<ElementId> held) = 0;
  /// The elements that the last call of relax moved; one that moved twice comes twice.
  virtual std::span<const ElementId> relaxed() const = 0;
  /// Leaves nothing active.
  virtual void sleep() = 0;

  virtual const Cuts& cuts() const = 0;
  virtual PositionView positions() const = 0;
  /// Writes every carried coordinate, element by element from `first` on, into `out` (space_dimension an element).
  virtual void copy_positions(ElementId first, std::span<float> out) const = 0;
  virtual void copy_positions(ElementId first, std::span<double> out) const = 0;
  /// Those of all elements (element_count x space_dimension).
  void copy_positions(std::span<float> out) const { copy_positions(0, out); }
  void copy_positions(std::span<double> out) const { copy_positions(0, out); }
  /// Takes every carried coordinate from `in`, as copy_positions wrote it.
  virtual void set_positions(std::span<const double> in) = 0;
  /// Where the elements of these blocks stand; no other may stand away from rest.
  virtual Snapshot placement(const ElementBlocks& away) const = 0;
  /// Puts elements there, and all others to rest; none outside `away` stands away from it now. It must be a placement
  /// of the mesh, of numbers within position_limit.
  virtual void place(const Snapshot& placement, const ElementBlocks& away) = 0;
  /// Brings these blocks of `kept` up to date; no element outside `away` may stand away from rest.
  virtual void keep_positions(const ElementBlocks& blocks, const ElementBlocks& away, PositionBlocks& kept) const = 0;
  /// Takes these blocks back; all others must stand as they were kept.
  virtual void restore(const PositionBlocks& kept, const ElementBlocks& blocks) = 0;
};

/// Throws Error where the algorithm does not work on the mesh.
std::unique_ptr<Solver> make_solver(const MeshPointer& mesh, Algorithm algorithm, Precision precision);

}  // namespace chainmail

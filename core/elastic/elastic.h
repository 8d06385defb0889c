#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "elastic/material.h"
#include "elastic/small.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// An object and its pins.
struct ElasticProblem {
  MeshPointer mesh;
  Cuts cuts;                    // of the mesh
  std::vector<ElementId> pins;  // ascending
  /// Displacements of the pins from rest, space_dimension coordinates each, in their order (mesh units).
  std::vector<double> pinned;
  ElasticOptions options;
};

/// A handle: elements that move as one rigid body. Displacements and arms have space_dimension coordinates per element
/// (mesh units). A handle of one element has none: its motion is its displacement from rest.
struct ElasticHandle {
  std::vector<ElementId> elements;    // ascending, none is pinned
  std::vector<double> displacements;  // from rest, when grabbed
  std::vector<double> arms;           // from the pivot, when grabbed

  static ElasticHandle of(ElementId element) { return {{element}, {}, {}}; }
  bool operator==(const ElasticHandle&) const = default;
};

/// A motion of a handle, from where it was grabbed: displaces an element at `arm` from the pivot by
/// turn · arm + translation.
struct ElasticMotion {
  SmallMatrix turn;         // the rotation matrix less the identity
  SmallVector translation;  // mesh units

  /// A translation without a rotation.
  static ElasticMotion by(std::span<const double> translation);
};

/// Displacement of element number i of a handle from rest (mesh units).
SmallVector displacement_of(const ElasticHandle& handle, std::size_t i, const ElasticMotion& motion);

/// A solver of one problem. It prepares once what depends on the object and its pins, and once per grab what depends on
/// the handle. A move costs only the rest.
///
/// Displacements are from rest, element by element, space_dimension coordinates each (mesh units). An element without a
/// cell stays at rest unless it is grabbed or pinned.
class ElasticSolver {
 public:
  virtual ~ElasticSolver() = default;

  /// Grabs a handle. May throw Error and Cancelled.
  virtual void hold(const ElasticHandle& handle, const Progress& progress = {}) = 0;
  /// Computes the static answer after a motion of the handle. Throws Error if there is none, and Cancelled; the last
  /// answer stays then.
  virtual void move(const ElasticMotion& motion, const Progress& progress = {}) = 0;
  /// Returns to rest, or to the answer to the pins, without a handle. The preparation stays.
  virtual void reset() = 0;
  /// Call this after others moved the object. Methods that depend on the path continue from these displacements.
  virtual void start_from(std::span<const double> /*displacements*/) {}
  /// Returns the last answer. Before the first one, this is the answer to the pins, or rest.
  virtual const std::vector<double>& displacements() const = 0;
  /// Reason why the last answer is not the requested one, and which one it is. Usually empty.
  virtual const std::string& remark() const = 0;
  /// True if the handle is at the target of the last move, whether the elements about it converged or not.
  virtual bool reached() const { return remark().empty(); }
  /// True if the answer depends on the path: then a rotation of the handle must be split into small ones.
  virtual bool follows_path() const { return false; }

  /// Returns the current positions of the control points that a user may drag (free-form deformation only):
  /// space_dimension coordinates each (mesh units). Indices run fastest along the first axis.
  virtual std::span<const double> control_points() const { return {}; }
  /// Moves a control point to a position (mesh units). Elements follow, pins stay.
  virtual void move_control_point(std::size_t /*point*/, std::span<const double> /*position*/) {}
};

/// A method of elasticity: a model of the static answer of an object to a handle. See methods.h.
struct ElasticMethod {
  std::uint64_t most_in_solids = 0;  // the largest number of elements of a solid in space that it accepts; 0: any
  /// Throws Error if it does not work on objects of this kind and size. Cheap: cells are not checked.
  void (*check)(const Mesh& mesh);
  /// Makes a solver. Throws Error if the problem has no answer with this method: flat or inverted cells, parts without
  /// enough pins, an open surface. Throws Cancelled.
  std::unique_ptr<ElasticSolver> (*make)(const ElasticProblem& problem, const Progress& progress);
};

}  // namespace chainmail

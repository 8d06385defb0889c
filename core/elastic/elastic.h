#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "elastic/material.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// How an object answers to a hand in statics, each by its own model.
enum class ElasticMethod { linear_fem, neo_hookean, boundary, free_form };

/// An object, and what holds it.
struct ElasticProblem {
  MeshPointer mesh;
  Cuts cuts;                    // of the mesh
  std::vector<ElementId> pins;  // ascending
  /// Where the pins stand from rest, space_dimension coordinates each, in their order (mesh units).
  std::vector<double> pinned;
  ElasticOptions options;
};

/// A solver of one problem. What depends on the object and its pins alone is prepared once; what depends on which
/// element is in the hand, when another one is taken hold of; a move costs what is left.
///
/// Displacements are from rest, element by element, space_dimension coordinates each (mesh units). An element that no
/// cell holds stays at rest unless it is in the hand or pinned.
class ElasticSolver {
 public:
  virtual ~ElasticSolver() = default;

  /// The hand takes hold of an element that is not pinned. May throw Error and Cancelled.
  virtual void hold(ElementId element, const Progress& progress = {}) = 0;
  /// The static answer while the held element stands at this displacement from rest (space_dimension coordinates).
  /// Throws Error where there is none at all, and Cancelled; it then answers as before.
  virtual void move(std::span<const double> displacement, const Progress& progress = {}) = 0;
  /// Back to rest, or where the pins have it, with no element in the hand; what was prepared stays.
  virtual void reset() = 0;
  /// The object was put there by others. What depends on the way that it came goes on from these displacements.
  virtual void start_from(std::span<const double> /*displacements*/) {}
  /// The last answer; that of the pins alone, or rest, before the first.
  virtual const std::vector<double>& displacements() const = 0;
  /// Where the last answer is not the one asked for: why, and which it is. Empty where it is.
  virtual const std::string& remark() const = 0;

  /// Control points that a user may drag: those of free-form deformation, displaced, space_dimension coordinates each
  /// (mesh units), the first axis running fastest.
  virtual std::span<const double> control_points() const { return {}; }
  /// Puts one of them somewhere (mesh units); elements follow, pins stay.
  virtual void move_control_point(std::size_t /*point*/, std::span<const double> /*position*/) {}
};

/// Whether a method works on objects of this kind and size, cells not looked at. Cheap.
bool fits(ElasticMethod method, const Mesh& mesh);
/// Throws Error, saying why and what to do, where it does not.
void check(ElasticMethod method, const Mesh& mesh);

/// Throws Error where the problem has no answer by this method: cells that are flat or inverted, parts that nothing
/// holds, an open surface, options out of range. Throws Cancelled.
std::unique_ptr<ElasticSolver> make_elastic(ElasticMethod method, const ElasticProblem& problem,
                                            const Progress& progress = {});

}  // namespace chainmail

#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "body/handle.h"
#include "measure/reference_solution.h"

namespace chainmail {

/// The elements whose rest positions are within a distance of a point.
struct Patch {
  Point centre = Point::Zero();
  double radius = 0;  // mesh units
};
/// Returns the elements of a patch, ascending, without those of `excluded` (ascending).
std::vector<ElementId> elements_in(const Mesh& mesh, const Patch& patch, const std::vector<ElementId>& excluded = {});

/// Returns the mean of the rest positions of some elements (mesh units).
Point middle_of(const Mesh& mesh, const std::vector<ElementId>& elements);

/// A reference counts as converged if the last refinement changed the answer by less than this share: the RMS of the
/// change over the RMS of the displacements, over the object's own elements.
inline constexpr double converged_change = 0.02;

/// The answer on one level of refinement.
struct ReferenceLevel {
  std::uint64_t elements = 0;
  std::optional<double> change;  // from the level before, as a share of the RMS displacement; none on the first level
};

/// How the answer changed from level to level.
struct Convergence {
  std::vector<ReferenceLevel> levels;
  std::optional<double> order;  // observed: the logarithm to base 2 of the ratio of the last two changes
  bool converged = false;
  std::string end;  // reason why the last level is the last one
};

/// A reference solution on the finest cells that were computed, at the object's own elements.
struct ConvergedReference : Convergence {
  ReferenceSolution solution;
};

struct ConvergingOptions {
  double change = converged_change;
  double seconds = 30;  // no level is begun that would probably exceed it
  int max_levels = 6;
  std::array<std::uint64_t, 4> max_elements{0, 100'000, 50'000, 12'000};  // by space dimension
  bool every_level = false;  // true: goes on to max_levels after it has converged
};

/// Computes the reference solution on cells that are refined uniformly until the answer at the object's own elements
/// changes little. The handle is a patch of the object's elements; on finer cells it is the same part of the object:
/// the cells, faces and edges between these elements. So are the pins. (A ball would cover another part on each level.)
/// Cut cells are missing on all levels. Each level starts from the answer of the level before.
///
/// A handle or pins without an edge between them are points, which have no continuum limit in a plane or in space.
/// Hexahedra and lattices are refined as the tetrahedra or triangles of the finite elements that they consist of.
/// Curved surfaces stay as they are on the object, so a converged reference is that of the object with flat faces.
class ConvergingReference {
 public:
  /// Throws Error if the object has no static solution, and Cancelled.
  explicit ConvergingReference(const ElasticProblem& problem, const ConvergingOptions& options = {},
                               const Progress& progress = {});

  /// Returns the solution with the elements of the patch displaced by `displacement` (mesh units), as far as the time
  /// and the limit of the method allow. Throws Error if the object's own cells have no answer, and Cancelled.
  ConvergedReference at(const Patch& patch, const Point& displacement, const Progress& progress = {});
  /// The same for these elements of the object (ascending, none pinned), which move as one rigid body about the mean of
  /// their rest positions.
  ConvergedReference at(const std::vector<ElementId>& handle, const RigidMotion& motion, const Progress& progress = {});

 private:
  struct Level;

  void add_level();
  // These return the displacements of all elements of a level.
  static std::vector<double> from_rest(Level& level, const std::vector<ElementId>& elements, const RigidMotion& motion,
                                       const Progress& progress);
  static std::vector<double> from_start(Level& level, const std::vector<ElementId>& elements,
                                        std::vector<double> displacements, const Progress& progress);
  bool is_last(ConvergedReference& result, double expected) const;

  ConvergingOptions options_;
  std::vector<std::shared_ptr<Level>> levels_;  // made when they are first needed
};

}  // namespace chainmail

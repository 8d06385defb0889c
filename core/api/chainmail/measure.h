#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/job.h"

namespace chainmail::api {

struct Access;

// All figures are computed in double, whatever the precision of the object.

/// Distance of the links from their valid regions, in rest lengths of the link. Cut links do not count.
struct Violation {
  double max = 0;           ///< Largest violation.
  double rms = 0;           ///< Root of the mean square over the links.
  double fraction = 0;      ///< Share of the links that are violated by more than 1e-4.
  std::uint64_t links = 0;  ///< Number of measured links.
};
/// Returns the violation of all links.
Violation violation(const Body& body);
/// Returns the violation of one link: the Euclidean norm of the excess per axis, in rest lengths. Throws Error if there
/// is no such link.
double violation(const Body& body, LinkId link);

/// A largest value and a mean over the elements.
struct Spread {
  double max = 0;  ///< Largest value.
  double rms = 0;  ///< Root of the mean square over all elements.
};
/// Returns the displacement of the elements from rest (mesh units).
Spread displacement(const Body& body);
/// Returns the distance between the elements of two states of the same mesh, in mean rest lengths. Throws Error if the
/// meshes differ.
Spread distance(const Body& one, const Body& other);
/// Returns the distance between an object and positions of its elements, x, y, z each (mesh units), in mean rest
/// lengths. Throws Error if the array has the wrong size or a coordinate is not finite.
Spread distance(const Body& body, std::span<const double> positions);

/// Returns the elastic energy of the body's kind over the uncut links. With the rest vector r of a link, its direction
/// r̂, the difference Δ of the displacements of its ends, its stiffness k, exponent p and lateral stiffness b, and the
/// volume v of the cells at the link, divided by its mean (1 without cells):
///
/// - isotropic: ½ Σ |Δ|² (mesh units squared)
/// - axial: ½ Σ k v |r|^p [(r̂·Δ)² + b |Δ|²]
/// - corotated: ½ Σ k v |r|^p [(|d| − |r|)² + b/2 (|d − R_i r|² + |d − R_j r|²)], where d is the vector of the link and
///   R_i the rotation of the surroundings of its end i (Sorkine and Alexa 2007)
/// - material: that of the cells, or of the triangles of a surface in space, which resist stretching and bending
///   (Young's modulus times mesh units to the power of the number of coordinates)
double elastic_energy(const Body& body);

/// The positions that a neo-Hookean elastic object has (Bonet and Wood 1997): finite elements on the object's own
/// cells or faces, converged by Newton's method, but not under refinement of the mesh.
class ReferenceSolution {
 public:
  /// The positions: x, y, z for each element (mesh units).
  std::vector<double> positions() const;
  /// Largest displacement of an element of the handle (mesh units).
  double handle_displacement() const;

 private:
  friend struct Access;
  struct Impl;
  explicit ReferenceSolution(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Returns the reference solution with the pins and these elements, the handle, at their current positions, with the
/// cuts and the elasticity of the object. Throws Error if an element does not exist, is given twice or is pinned, if
/// the handle is at rest, if there are no cells or faces, if the pins are too few, or if it does not converge; and
/// Cancelled.
ReferenceSolution reference_solution(const Body& body, const std::vector<ElementId>& handle, const Job& job = {});

/// Distance from a reference solution, over all elements.
struct PhysicalError {
  double relative = 0;  ///< RMS of the error over RMS of the reference's displacements. About 1 if nothing moves.
  double rms = 0;       ///< RMS of the error over the handle's displacement.
  double max = 0;       ///< Largest error over the handle's displacement.
};
/// Returns the error of the current positions. Throws Error if the reference is of another mesh.
PhysicalError physical_error(const Body& body, const ReferenceSolution& reference);
/// Returns the error of an object of which only handle and pins move: a method with a larger error is worse than none.
PhysicalError physical_error_of_rest(const ReferenceSolution& reference);

}  // namespace chainmail::api

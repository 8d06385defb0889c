#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "elastic/stiffening.h"
#include "elastic/surface_cells.h"
#include "equilibrium/bending_moments.h"
#include "equilibrium/block_vectors.h"
#include "equilibrium/loose_links.h"
#include "equilibrium/shared_loop.h"
#include "mesh/cuts.h"

namespace chainmail {

/// Thickness of a surface in space (mesh units).
double thickness_of(const Mesh& mesh, const ElasticOptions& elastic);

/// The elastic energy of a surface in space, per thickness: that of stretching its triangles, with the density of
/// elastic/stiffening.h in plane stress, plus that of bending, E t² / (12 (1 − ν²)) times that of BendingMoments. The
/// turn of a hinge is the angle between the normals of its triangles, less that at rest (Grinspun et al. 2003).
///
/// The hinges of a triangle that is compressed below a tenth of its area fade out: it has hardly a normal. A cut link
/// removes the triangles along it. An element that no triangle holds any more is kept by its links, as in
/// MaterialEnergy; numbers are scaled in the same way, too.
class SurfaceEnergy {
 public:
  using Vector = FixedMatrix<double, 3>;
  using Vectors = BlockVectors<double, 3>;

  /// Makes the triangles of a mesh, none cut. Throws Cancelled.
  void build(MeshPointer mesh, const Progress& progress = {});
  void set_material(const ElasticOptions& elastic, const Progress& progress = {});
  /// Removes and restores triangles. Returns the links whose weights changed, ascending.
  std::vector<LinkId> set_cuts(const Cuts& cuts);

  /// As MaterialEnergy::weight; bending does not count.
  double weight(LinkId link) const;
  static constexpr double least_weight = 0.02;

  /// Returns the energy at these displacements from rest, and writes its negative gradient, if given.
  double evaluate(const Vectors& displacements, Vectors* force, const SharedLoop& shared = {});
  /// The least ratio of a triangle's area to that at rest in the last evaluation.
  double least_volume() const { return least_; }
  /// True if a triangle had hardly an area in the last evaluation.
  bool is_inverted() const { return least_ < measured_below; }
  static constexpr double measured_below = 0.01;
  void set_extension_below(double volume) { density_.set_least_volume(volume); }
  double extension_below() const { return density_.least_volume(); }
  double scale() const { return scale_; }

  // The curvature of the energy, for a preconditioner.

  const Mesh& mesh() const { return *mesh_; }
  const SurfaceCells& cells() const { return cells_; }
  bool is_whole(std::uint32_t triangle) const { return is_whole_[triangle] != 0; }
  using TriangleMatrix = FixedMatrix<double, 9, 9>;
  using HingeVector = FixedMatrix<double, 12>;
  /// Returns the Hessian of a triangle, without negative curvature (Teran et al. 2005), by its corners' coordinates.
  TriangleMatrix curvature_of_triangle(std::uint32_t triangle, const Vectors& displacements) const;
  /// Returns the vector c for which c cᵀ approximates the Hessian of a hinge, by its corners' coordinates.
  HingeVector curvature_of_hinge(std::size_t hinge, const Vectors& displacements) const;
  /// The springs of elements without triangles.
  std::span<const LinkId> loose_links() const { return loose_.links(); }

 private:
  using Frame = std::array<Vector, 2>;  // columns
  struct Rest {
    Frame frame;                                      // two axes in the plane of the triangle
    std::array<FixedMatrix<double, 2>, 3> gradients;  // of the corners' shape functions (1 / mesh unit)
    double area = 0;                                  // (mesh units squared)
  };
  struct Turn {
    double value = 0;             // of a hinge, times its edge, faded
    std::array<Vector, 4> slope;  // by its corners
  };

  void find_rest();
  void find_triangles();
  void find_pulls();
  double bending() const;  // stiffness of the plate per thickness and Young's modulus, divided by the scale
  double stiffness_around(LinkId link) const;
  Vector position(ElementId e, const Vectors& displacements) const {
    return Vector::from(mesh_->rest.data() + 3 * std::size_t{e}) + displacements[e];
  }
  Frame stretch_of(std::uint32_t triangle, const Vectors& displacements, Frame& strain) const;
  double stretch(std::uint32_t triangle, const Vectors& displacements, bool wants_force);
  double bend(const Vectors& displacements, bool wants_force, const SharedLoop& shared);
  void turn(std::size_t hinge, const Vectors& displacements, Turn& turn, bool wants_slope) const;

  MeshPointer mesh_;
  SurfaceCells cells_;
  BendingMoments moments_;
  std::vector<Rest> rest_;
  std::vector<double> rest_turn_;                          // of each hinge (radians)
  std::vector<std::uint32_t> first_triangle_, triangles_;  // of each link: the triangles that need it
  std::vector<std::uint32_t> first_pull_, pulls_;          // of each element: its places in pull_
  std::vector<std::uint8_t> is_whole_;                     // of each triangle
  std::vector<std::uint32_t> whole_beside_;                // of each element: its whole triangles
  std::vector<std::uint8_t> is_cut_;                       // of each link
  LooseLinks<3> loose_;

  // Of the last evaluation.
  std::vector<double> ratio_;  // of each triangle's area to that at rest
  std::vector<Turn> turns_;    // of each hinge
  std::vector<double> turned_, moment_;
  std::vector<Vector> pull_;  // the forces of each triangle, then of each hinge, on its corners

  Lame lame_;
  double poisson_ = 0, thickness_ = 0;  // (mesh units)
  ExtendedDensity density_{StrainLaw(), Lame{0.5, 0}, 2};
  double scale_ = 1;
  double least_ = 1;
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "equilibrium/laplacian_preconditioner.h"
#include "equilibrium/material_energy.h"
#include "equilibrium/quasi_newton.h"
#include "equilibrium/region_penalties.h"

namespace chainmail {

/// Finds the displacements of least energy of the material of an object, step by step: a quasi-Newton method (L-BFGS)
/// whose first inverse is a multigrid on the weighted Laplacian of the links (after Liu, Bouaziz and Kavan 2017, who
/// factor it). A cut repairs the multigrid around it.
///
/// Cells below the ratio of volumes `extension_below` of MaterialEnergy resist less than the material does. A search
/// begins with a high ratio, so that inverted cells turn back, and ends with a low one, when all cells are above it.
template <int D>
class MaterialMinimum {
 public:
  using Vectors = typename MaterialEnergy<D>::Vectors;

  void begin(const MeshPointer& mesh, const Progress& progress);
  bool has_begun() const { return has_begun_; }
  void set_material(const Material& material, const StrainLaw& law);
  void set_cuts(const Cuts& cuts);
  /// Sets whether an element is fixed, unless it is already so.
  void set_fixed(ElementId element, bool fixed);
  /// Forgets what belongs to other displacements.
  void forget();

  /// Brings the multigrid up to date. Returns true if it built one.
  bool update(const Progress& progress);
  /// Continues the displacements of fixed elements, `jump`, which is 0 at all others, to those around them: adds the
  /// solution of Laplace's equation, approximated by one cycle. Call update() before.
  void extend(const Vectors& jump, Vectors& at);
  /// Returns the energy, without the springs of regions.
  double energy_of(const Vectors& at) { return energy_.evaluate(at, nullptr); }
  /// True if a cell is inverted.
  bool is_inverted(const Vectors& at);

  /// Runs a step, on at most this many threads. Call update() before.
  void step(Vectors& at, int threads);
  double energy() const { return value_; }
  /// Estimated distance from the minimum, as √(twice the energy of the distance).
  double distance() const { return distance_; }

  /// A link's stiffness, as the springs of regions count it.
  double stiffness(LinkId link) const {
    return weights_[link] > 0 ? std::max(MaterialEnergy<D>::least_weight, weights_[link]) : 0;
  }
  RegionPenalties<D>& regions() { return regions_; }
  /// Tells that the forces of regions changed, and the working set at these links.
  void follow_regions(std::span<const LinkId> changed);

 private:
  double evaluate(const Vectors& at, Vectors& force, const SharedLoop& shared);
  double add_regions(const Vectors& at, Vectors& force) const;
  void harden(const Vectors& at, const SharedLoop& shared);

  bool has_begun_ = false;
  MaterialEnergy<D> energy_;
  LaplacianPreconditioner<D> preconditioner_;
  QuasiNewton<D> newton_;
  RegionPenalties<D> regions_;
  std::vector<double> weights_;  // of each link
  Vectors force_;                // the negative gradient, with the springs of regions
  // Of the material alone, at the displacements that were evaluated last.
  Vectors material_force_;
  double material_value_ = 0;
  Vectors step_, pull_;
  double value_ = 0, distance_ = 0;
  bool is_outdated_ = true;           // the gradient
  bool is_material_outdated_ = true;  // that of the material, too
};

extern template class MaterialMinimum<1>;
extern template class MaterialMinimum<2>;
extern template class MaterialMinimum<3>;

}  // namespace chainmail

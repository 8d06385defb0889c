#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "equilibrium/laplacian_preconditioner.h"
#include "equilibrium/material_energy.h"
#include "equilibrium/quasi_newton.h"
#include "equilibrium/region_constraints.h"

namespace chainmail {

/// Finds the displacements of least energy of the material of an object, step by step.
template <int D>
class EnergyMinimum {
 public:
  using Vectors = typename MaterialEnergy<D>::Vectors;

  EnergyMinimum() = default;
  EnergyMinimum(const EnergyMinimum&) = delete;
  EnergyMinimum& operator=(const EnergyMinimum&) = delete;
  virtual ~EnergyMinimum() = default;

  virtual void begin(const MeshPointer& mesh, const Progress& progress) = 0;
  virtual bool has_begun() const = 0;
  /// Throws Cancelled; call it again then.
  virtual void set_material(const ElasticOptions& elastic, const Progress& progress) = 0;
  virtual void set_cuts(const Cuts& cuts) = 0;
  /// Sets whether an element is fixed, unless it is already so.
  virtual void set_fixed(ElementId element, bool fixed) = 0;
  /// Forgets what belongs to other displacements.
  virtual void forget() = 0;

  /// Brings the multigrid up to date. Returns true if it built one.
  virtual bool update(const Progress& progress) = 0;
  /// Continues the displacements of fixed elements, `jump`, which is 0 at all others, to those around them: adds the
  /// solution of Laplace's equation, approximated by one cycle. Call update() before.
  virtual void extend(const Vectors& jump, Vectors& at, int threads) = 0;
  /// Returns the energy, without the springs of regions.
  virtual double energy_of(const Vectors& at) = 0;
  /// True if a cell is inverted, or a triangle in space has no area. A step from these displacements need not compute
  /// the gradient again.
  virtual bool is_inverted(const Vectors& at, int threads) = 0;

  /// Runs a step, on at most this many threads. Call update() before. Throws Cancelled; nothing has moved then. Returns
  /// true if it prepared later ones, which takes as long as tens of them.
  virtual bool step(Vectors& at, int threads, const Progress& progress) = 0;
  virtual double energy() const = 0;
  /// Estimated distance from the minimum, as √(twice the energy of the distance).
  virtual double distance() const = 0;

  /// A link's stiffness, as the springs of regions count it.
  virtual double stiffness(LinkId link) const = 0;
  virtual RegionPenalties<D>& regions() = 0;
  /// Tells that the forces of regions changed, and the working set at these links.
  virtual void follow_regions(std::span<const LinkId> changed) = 0;
};

/// Returns the minimum for the material of this mesh: that of its cells, or of a surface in space.
template <int D>
std::unique_ptr<EnergyMinimum<D>> make_minimum(const Mesh& mesh);

/// The steps of a quasi-Newton method (L-BFGS) whose first inverse is a multigrid on the weighted Laplacian of the
/// links (after Liu, Bouaziz and Kavan 2017, who factor it). A cut repairs the multigrid around it.
template <int D>
class MultigridSteps {
 public:
  using Energy = MaterialEnergy<D>;

  void begin(const Energy& /*energy*/, const Progress& /*progress*/) {}
  void forget() { newton_.forget(); }
  void outdate_inverse() { newton_.forget(); }
  double distance() const { return newton_.distance(); }
  static bool has_prepared() { return false; }

  template <class Evaluate, class Inverse>
  bool step(Evaluate evaluate, const Energy& /*energy*/, Inverse& inverse, const RegionPenalties<D>& /*regions*/,
            typename Energy::Vectors& at, double& value, typename Energy::Vectors& force, const SharedLoop& shared,
            const Progress& /*progress*/) {
    return newton_.step(evaluate, inverse, at, value, force, shared);
  }

 private:
  QuasiNewton<D> newton_;
};

/// Cells below the ratio of volumes `extension_below` of the energy resist less than the material does. A search begins
/// with a high ratio, so that inverted cells turn back, and ends with a low one, when all cells are above it.
template <int D, class Steps = MultigridSteps<D>>
class MaterialMinimum final : public EnergyMinimum<D> {
 public:
  using Vectors = typename EnergyMinimum<D>::Vectors;

  void begin(const MeshPointer& mesh, const Progress& progress) override;
  bool has_begun() const override { return has_begun_; }
  void set_material(const ElasticOptions& elastic, const Progress& progress) override;
  void set_cuts(const Cuts& cuts) override;
  void set_fixed(ElementId element, bool fixed) override;
  void forget() override;
  bool update(const Progress& progress) override { return preconditioner_.update(progress); }
  void extend(const Vectors& jump, Vectors& at, int threads) override;
  double energy_of(const Vectors& at) override;
  bool is_inverted(const Vectors& at, int threads) override;
  bool step(Vectors& at, int threads, const Progress& progress) override;
  double energy() const override { return value_; }
  double distance() const override { return distance_; }
  double stiffness(LinkId link) const override {
    return weights_[link] > 0 ? std::max(Energy::least_weight, weights_[link]) : 0;
  }
  RegionPenalties<D>& regions() override { return regions_; }
  void follow_regions(std::span<const LinkId> changed) override;

 private:
  using Energy = typename Steps::Energy;

  double evaluate(const Vectors& at, Vectors& force, const SharedLoop& shared);
  double add_regions(const Vectors& at, Vectors& force, const SharedLoop& shared) const;
  void find_gradient(const Vectors& at, const SharedLoop& shared);
  void clear_fixed(Vectors& force, const SharedLoop& shared) const;
  void harden(const Vectors& at, const SharedLoop& shared);

  bool has_begun_ = false;
  Energy energy_;
  LaplacianPreconditioner<D> preconditioner_;
  Steps steps_;
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
  bool has_changed_cells_ = false;    // since that of the material was computed
};

extern template std::unique_ptr<EnergyMinimum<1>> make_minimum(const Mesh& mesh);
extern template std::unique_ptr<EnergyMinimum<2>> make_minimum(const Mesh& mesh);
extern template std::unique_ptr<EnergyMinimum<3>> make_minimum(const Mesh& mesh);

}  // namespace chainmail

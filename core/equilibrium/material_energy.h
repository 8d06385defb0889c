#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/positions.h"
#include "elastic/simplices.h"
#include "elastic/stiffening.h"
#include "equilibrium/loose_links.h"
#include "equilibrium/shared_loop.h"
#include "equilibrium/simplex_batches.h"
#include "mesh/cuts.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

/// The elastic energy of the material of an object's cells, as neo-Hookean finite elements have it: constant strain in
/// the simplices of its cells (see elastic/simplices.h), with the density of elastic/stiffening.h, which is defined for
/// inverted cells too. In a plane it is that of plane stress.
///
/// A cut link removes the cells along it. An element that no cell holds any more is kept by its links: springs of
/// their rest lengths, so weak that the cells do not feel them.
///
/// Energies are divided by the mean stiffness of links, see weight(), so that numbers are near 1.
template <int Dimension>
class MaterialEnergy {
 public:
  using Vector = FixedMatrix<double, Dimension>;
  using Square = Eigen::Matrix<double, Dimension, Dimension>;
  using Vectors = std::vector<Vector>;

  /// Makes the cells of a mesh, none cut. Throws Cancelled.
  void build(MeshPointer mesh, const Progress& progress = {});
  /// Sets Poisson's ratio and the law. Young's modulus does not move a minimum. Changes all weights. Throws Cancelled;
  /// call it again then.
  void set_material(const ElasticOptions& elastic, const Progress& progress = {});
  /// Removes and restores cells. Returns the links whose weights changed, ascending. Costs as much as there are cuts.
  std::vector<LinkId> set_cuts(const Cuts& cuts);

  /// The stiffness of a link in an approximation of the energy: the Laplacian of the cells with the modulus 2μ + λ
  /// (after Liu, Bouaziz and Kavan 2017), without the entries of the wrong sign of obtuse cells. 0 if the link is cut.
  double weight(LinkId link) const;
  /// The least weight of a link between elements that cells hold.
  static constexpr double least_weight = 0.02;

  /// Returns the energy at these displacements from rest, and writes its negative gradient, if given.
  double evaluate(const Vectors& displacements, Vectors* force, const SharedLoop& shared = {});
  /// Adds what calls of set_cuts() since the last evaluation, which was at these displacements, changed in the energy
  /// and its negative gradient. Returns the change of the energy.
  double add_changes(const Vectors& displacements, Vectors& force);
  /// The least ratio of a cell's volume to that at rest in the last evaluation; below 0 if a cell is inverted. A
  /// cell that was removed since then still counts.
  double least_volume() const { return least_; }
  bool is_inverted() const { return least_ < 0; }
  /// See ExtendedDensity. Where an energy is measured, the ratio is `measured_below`.
  static constexpr double measured_below = 0.01;
  void set_extension_below(double volume) { density_.set_least_volume(volume); }
  double extension_below() const { return density_.least_volume(); }
  /// The energy that counts as 1, for a Young's modulus of 1.
  double scale() const { return scale_; }

 private:
  using Batch = SimplexBatch<Dimension>;

  /// A run of batches. Parts are evaluated at the same time, each with the forces on its own range of elements; their
  /// number depends on the object alone, and so do the bits of the sum.
  struct Part {
    std::size_t first = 0, last = 0;         // batches
    ElementId low = 0, high = 0;             // the elements of their corners are below `high`
    std::vector<FourNumbers> displacements;  // of the elements from `low` on
    std::vector<FourNumbers> force;          // on them
    BatchSum sum;
  };

  void find_cell_links(const Progress& progress);
  void divide(const Progress& progress);
  void evaluate(Part& part, const Vectors& displacements, bool wants_force) const;
  std::vector<std::uint32_t> take_cuts(const Cuts& cuts, std::vector<LinkId>& changed);
  void update_loose(const Cuts& cuts, std::span<const std::uint32_t> cells, std::vector<LinkId> changed);
  std::vector<std::uint32_t> take_changed_cells();
  void set_cell(std::uint32_t cell, bool is_whole);
  void set_volume(std::uint32_t simplex, bool is_whole);
  double stiffness_around(LinkId link) const;
  void set_simplex(Batch& batch, std::size_t lane, std::size_t simplex) const;
  void copy_gradients(std::size_t simplex, Batch& batch, std::size_t lane) const;
  Vector gradient(std::size_t simplex, std::size_t corner) const;
  BatchDensity batch_density() const { return {is_neo_hookean_, lame_, &density_}; }

  MeshPointer mesh_;
  CellSimplices cells_;                                  // without gradients: the batches have them
  std::vector<std::uint32_t> first_simplex_;             // of each cell, and the end
  std::vector<std::uint32_t> first_cell_, cell_beside_;  // of each link: the cells that need it
  std::vector<std::uint8_t> is_whole_;                   // of each cell
  std::vector<std::uint32_t> whole_beside_;              // of each element: its whole cells
  std::vector<std::uint8_t> is_cut_;                     // of each link
  std::vector<LinkId> cut_links_;                        // ascending
  std::vector<Batch> batches_;
  std::vector<Part> parts_;
  LooseLinks<Dimension> loose_;
  std::vector<std::uint32_t> changed_cells_;           // removed or restored since the last evaluation
  std::optional<LooseLinks<Dimension>> loose_before_;  // at the last evaluation, if others were loose then

  Lame lame_;
  bool is_neo_hookean_ = true;
  ExtendedDensity density_{StrainLaw(), Lame{0.5, 0}, Dimension};
  double scale_ = 1;
  double least_ = 1;
};

extern template class MaterialEnergy<1>;
extern template class MaterialEnergy<2>;
extern template class MaterialEnergy<3>;

/// Returns the energy of the material of a mesh's uncut cells, or of its uncut triangles in space, in units of Young's
/// modulus times mesh units to the power of the space's dimension. See has_material.
double material_energy(const Mesh& mesh, const ElasticOptions& elastic, const Cuts& cuts, const PositionView& position);

}  // namespace chainmail

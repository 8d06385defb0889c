#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/softness.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solver/deformer.h"

namespace chainmail {

/// The relaxed equilibrium: the minimum of the elastic energy (see equilibrium/link_energy.h) while some elements are
/// fixed. Valid regions are ignored.
struct Equilibrium {
  /// Displacements from rest, element by element, space_dimension coordinates each (mesh units). Unlike positions, they
  /// lose no digits if the origin is far away or the object is large.
  std::vector<double> displacements;
  /// True, per element, if uncut links connect it to a fixed element. Otherwise its position is not determined, and it
  /// stays where it is.
  std::vector<bool> defined;
  /// True if a link between connected elements violates its valid region. Relaxation cannot reach such an equilibrium,
  /// so it is not a reference for relaxation.
  bool binds = false;

  /// The positions (mesh units); valid while this object and the mesh exist.
  PositionView positions(const Mesh& mesh) const;
};

/// Number of elements up to which sparse Cholesky is used; above, conjugate gradients, whose memory is linear.
inline constexpr std::uint64_t cholesky_limit = 65'536;

/// Returns the equilibrium with these elements fixed at their positions; the positions of the others are only the start
/// of the iterations. The energies of corotated links and of the material may have several minima: this is the one that
/// they find. None if no element is fixed, if the energy has no single minimum, or if the iterations do not converge.
/// May throw Cancelled.
std::optional<Equilibrium> equilibrium(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                       std::span<const ElementId> fixed, const PositionView& positions,
                                       const ElasticOptions& elastic = {}, std::uint64_t limit = cholesky_limit,
                                       const Progress& progress = {});

}  // namespace chainmail

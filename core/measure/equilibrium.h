#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solve/softness.h"
#include "solve/solver.h"

namespace chainmail {

/// The relaxed equilibrium: the minimum of the elastic energy ½ Σ |(x_j − x_i) − r_ij|² while some elements are fixed.
/// Valid regions are ignored.
struct Equilibrium {
  /// Displacements from rest, element by element, space_dimension coordinates each (mesh units): so neither a far
  /// origin nor a large object costs digits.
  std::vector<double> displacements;
  /// True, per element, if its component, over the links that are not cut, contains a fixed element. Otherwise every
  /// translation is equally good, and the element keeps its position.
  std::vector<bool> defined;
  /// True if a link between such elements is outside its valid region. Then it is not a reference for relaxation, which
  /// cannot reach it.
  bool binds = false;

  /// The positions (mesh units); valid while this object and the mesh exist.
  PositionView positions(const Mesh& mesh) const;
};

/// Number of elements up to which sparse Cholesky is used; above, conjugate gradients, whose memory is linear.
inline constexpr std::uint64_t cholesky_limit = 65'536;

/// Returns the equilibrium with these elements fixed at their positions; the positions of the others are only the start
/// of conjugate gradients. None if no element is fixed, or if conjugate gradients do not converge. May throw Cancelled.
std::optional<Equilibrium> equilibrium(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                       std::span<const ElementId> fixed, const PositionView& positions,
                                       std::uint64_t limit = cholesky_limit, const Progress& progress = {});

}  // namespace chainmail

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

/// The relaxed equilibrium: where the elastic energy ½ Σ |(x_j − x_i) − r_ij|² is least while some elements
/// are fixed. Regions play no part in it.
struct Equilibrium {
  /// From rest, element by element, space_dimension coordinates each (mesh units): so neither a far origin
  /// nor a large object costs digits.
  std::vector<double> displacements;
  /// Per element: whether its component, over the links that are not cut, holds a fixed element. Without one
  /// every translate is as good, and the element is left where it stands.
  std::vector<bool> defined;
  /// A link between such elements lies outside its valid region. Relaxation, which keeps to the regions,
  /// cannot come there then: it is no reference.
  bool binds = false;

  /// The positions (mesh units); valid as long as this and the mesh.
  PositionView positions(const Mesh& mesh) const;
};

/// Up to this many elements by sparse Cholesky, above by conjugate gradients: its memory is linear.
inline constexpr std::uint64_t cholesky_limit = 65'536;

/// The equilibrium with these elements fixed where they stand; the others' positions are only where
/// conjugate gradients begin. Nothing where no element is fixed, and where conjugate gradients do not come
/// to an end. May leave by Cancelled.
std::optional<Equilibrium> equilibrium(const Mesh& mesh, const Softness& softness, const Cuts& cuts,
                                       std::span<const ElementId> fixed, const PositionView& positions,
                                       std::uint64_t limit = cholesky_limit, const Progress& progress = {});

}  // namespace chainmail

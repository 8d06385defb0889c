#pragma once

#include "body/positions.h"
#include "body/softness.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Stiffness of a link along its rest vector and in all directions. With the rest vector r, its direction r̂ = r/|r| and
/// the difference Δ of the displacements of the link's ends, the energy of a link is
///
///     ½ [axial · (r̂·Δ)² + lateral · |Δ|²]
///
/// | kind             | axial      | lateral      |
/// |------------------|------------|--------------|
/// | isotropic        | 0          | 1            |
/// | axial, corotated | k·v·|r|^p | k·v·|r|^p·b |
///
/// with the stiffness k, the exponent p and the lateral stiffness b of the link, and the share v of the material that
/// it stands for (see LinkShares). For `corotated`, see CorotatedEnergy. A link of zero length has no direction: its
/// axial stiffness is 0, and the mesh's mean rest length takes the place of |r|.
struct LinkWeights {
  double axial = 0;
  double lateral = 0;
};

LinkWeights link_weights(const Mesh& mesh, const Softness& softness, LinkId link);
/// The same for a link of this softness and rest length (mesh units) that stands for a mean share of material.
LinkWeights link_weights(const Mesh& mesh, EnergyKind kind, const LinkSoftness& softness, double rest_length);

/// Returns the kind of energy that a mesh has: without cells and faces there is no material; links are corotated.
EnergyKind energy_in(const Mesh& mesh, EnergyKind kind);

/// Returns the corotated energy (see CorotatedEnergy). It does not change under rotations of the object.
double corotated_energy(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position);

}  // namespace chainmail

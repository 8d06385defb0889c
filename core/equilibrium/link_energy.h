#pragma once

#include "body/positions.h"
#include "body/softness.h"
#include "elastic/material.h"
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

/// Returns the elastic energy over the uncut links, of the kind that the softness names (for corotated links,
/// see CorotatedEnergy), or of the material of its cells, in double. The isotropic one, ½ Σ |(x_j − x_i) −
/// r_ij|², is in mesh units squared; that of the material, as neo-Hookean FEM has it, in units of Young's modulus times
/// mesh units to the power of the space's dimension.
double elastic_energy(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                      const ElasticOptions& elastic = {});

}  // namespace chainmail

#pragma once

#include <Eigen/Core>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/positions.h"
#include "solve/softness.h"

namespace chainmail {

/// Stiffness of a link along its rest vector and in all directions. With the rest vector r, its direction r̂ = r/|r| and
/// the difference Δ of the displacements of the link's ends, the energy of a link is
///
///     ½ [axial · (r̂·Δ)² + lateral · |Δ|²]
///
/// | kind                | axial   | lateral   |
/// |---------------------|---------|-----------|
/// | isotropic           | 0       | 1         |
/// | axial, corotated    | k·|r|^p | k·|r|^p·b |
///
/// with the stiffness k, the exponent p and the lateral stiffness b of the link. `corotated` applies them to the turned
/// rest vector (see corotated_energy). A link of zero length has no direction: its axial stiffness is 0, and the mesh's
/// mean rest length takes the place of |r|.
struct LinkWeights {
  double axial = 0;
  double lateral = 0;
};

LinkWeights link_weights(const Mesh& mesh, const Softness& softness, LinkId link);
/// The same for a link of this softness and rest length (mesh units).
LinkWeights link_weights(const Mesh& mesh, EnergyKind kind, const LinkSoftness& softness, double rest_length);

/// The rotation of an element's neighbourhood, of which the first rows and columns exist in the space.
using LocalRotation = Eigen::Matrix3d;

/// Returns the rotation R that brings the rest vectors r of the links of an element closest to their vectors d: it
/// minimises Σ axial |d − R r|² over its uncut links (Sorkine and Alexa 2007). It is the rotation in the polar
/// decomposition of Σ axial d rᵀ. On a line it is 1. If the links do not determine it, it is one of the closest.
LocalRotation local_rotation(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                             ElementId element);

/// Returns the mean of the rest vectors of a link as the neighbourhoods of its ends turn them, ½ (R_a + R_b) r.
Eigen::Vector3d turned_rest_vector(const Mesh& mesh, LinkId link, const LocalRotation& a, const LocalRotation& b);

/// Returns the corotated energy ½ Σ axial (q·d − |r|)² + lateral |d − t|² over the uncut links, where d is the vector
/// of a link, t is turned_rest_vector and q = t/|t|. It does not change under rotations of the object.
double corotated_energy(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position);

}  // namespace chainmail

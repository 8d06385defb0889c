#pragma once

#include "solver/algorithms.h"

namespace chainmail {

/// Returns an entry for add_algorithm: the finite elements of the physics engine Bullet, for objects in space.
///
/// Stable neo-Hookean tetrahedra (Smith, de Goes and Kim 2018) with the material of the body's elastic options; a cell
/// with a cut link is left out, as in our own FEM. Each frame is a step of the implicit Euler method by Bullet's Newton
/// iterations and conjugate gradients. Masses are those of the cells' volumes; there is no gravity, air or contact. A
/// move sets the handle to its target and runs frames, at most `iterations` of the body's elastic options, until the
/// object rests. It goes on with the velocities of the last move. Throws Error at the first move of an object in a
/// plane or on a line, for which Bullet has no elements.
AlgorithmInfo bullet_fem();

}  // namespace chainmail

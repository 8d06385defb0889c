#pragma once

#include "solver/algorithms.h"

namespace chainmail {

/// Returns an entry for add_algorithm: the soft body of the physics engine Bullet, with the links of the object.
///
/// Links have full stiffness and masses are equal; there is no gravity, air or contact. A move sets the handle to its
/// target and runs frames of one iteration, with some damping, until the object rests. It starts from the present
/// positions, so the answer depends on the path. At most `iterations` frames of the body's elastic options are run.
AlgorithmInfo bullet_soft_body();

}  // namespace chainmail

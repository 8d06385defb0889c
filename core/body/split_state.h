#pragma once

#include "body/snapshot.h"
#include "mesh/split.h"

namespace chainmail {

/// Returns the object after a split; for cuts and pins see mesh/split.h. A link on an old one has the softness of that
/// one. A link inside a face has the mean softness of the links on which it ends, if one of them has its own.
ObjectState object_after(const Split& split, const ObjectState& object);

/// Returns the positions after a split. New elements are between their elements, as they are at rest.
Snapshot positions_after(const Split& split, const Snapshot& positions, Precision precision);

}  // namespace chainmail

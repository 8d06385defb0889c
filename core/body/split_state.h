#pragma once

#include <memory>

#include "body/snapshot.h"
#include "body/softness.h"
#include "mesh/split.h"

namespace chainmail {

/// Returns the softness after a split. A link on an old one has the softness of that one. A link inside a face has the
/// mean softness of the links on which it ends, if one of them has its own.
std::shared_ptr<const Softness> softness_after(const Split& split, const std::shared_ptr<const Softness>& softness);

/// Returns the positions after a split. New elements are between their elements, as they are at rest.
Snapshot positions_after(const Split& split, const Snapshot& positions, Precision precision);

}  // namespace chainmail

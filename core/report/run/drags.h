#pragma once

#include <vector>

#include "mesh/progress.h"
#include "report/run/cases.h"

namespace chainmail::report {

/// Returns three drags for an object.
/// - local: the element nearest to the middle moves until about an eighth of the object follows;
/// - whole body: an element of the boundary moves outward until all elements follow, and as far again;
/// - back and forth: the middle moves until all elements follow, and back.
/// Exact ChainMail determines the distances, so they do not depend on the contestants. If it is cancelled, the
/// drags are shorter.
std::vector<RecordedMoves> three_drags(const Case& object, const Progress& progress = {});

}  // namespace chainmail::report

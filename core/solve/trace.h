#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Where a candidate has no sponsor.
inline constexpr ElementId no_element = std::numeric_limits<ElementId>::max();

/// One processed candidate of a pass.
struct TraceRow {
  ElementId element;
  ElementId sponsor;
  bool moved;
};
using Trace = std::vector<TraceRow>;

}  // namespace chainmail

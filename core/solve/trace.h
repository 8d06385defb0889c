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

/// What a pass did: candidates taken and not dropped, and elements moved without the grabbed one.
struct PassCount {
  std::uint64_t checked = 0;
  std::uint64_t moved = 0;
  bool stopped = false;      // Exact ChainMail: pins held the hand short of its target
  std::uint64_t visits = 0;  // Exact ChainMail: of elements, with those before pins held the hand back
};

}  // namespace chainmail

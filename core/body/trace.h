#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// One processed candidate of a pass.
struct TraceRow {
  ElementId element;
  ElementId sponsor;  // no_element for a candidate without one
  bool moved;
};
using Trace = std::vector<TraceRow>;

/// Numbers of a pass: candidates processed, and elements moved, without the handle.
struct PassCount {
  std::uint64_t checked = 0;
  std::uint64_t moved = 0;
  /// Exact ChainMail: pins, or in a rotation links outside the handle, stopped it before its target.
  bool stopped = false;
  std::uint64_t visits = 0;  // Exact ChainMail: visits of elements, including those before pins stopped the handle
};

}  // namespace chainmail

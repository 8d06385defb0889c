#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "mesh/mesh.h"

namespace chainmail {

/// Two elements in one number, in any order: the key of the edge of a face.
using EdgeKey = std::uint64_t;

constexpr EdgeKey edge_key(ElementId a, ElementId b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }
/// Returns the two elements, the lower one first.
constexpr std::array<ElementId, 2> ends_of(EdgeKey key) {
  return {static_cast<ElementId>(key >> 32), static_cast<ElementId>(key)};
}

}  // namespace chainmail

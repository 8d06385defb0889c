#pragma once

#include "body/softness.h"
#include "mesh/cuts.h"
#include "reference/exact.h"

namespace chainmail::test {

/// Returns what Bellman and Ford find for an object with this softness and these cuts.
inline reference::LeastAnswer bellman_and_ford(const MeshPointer& mesh, const Softness& softness, const Cuts& cuts) {
  const auto factors = [mesh, softness](ElementId a, ElementId b) {
    const LinkSoftness& link = softness.of(*find_link(*mesh, a, b));
    return reference::Factors{link.compression, link.stretch, link.shear};
  };
  const auto cut = [mesh, cuts](ElementId a, ElementId b) { return cuts.is_cut(*find_link(*mesh, a, b)); };
  return {mesh, factors, cut};
}

}  // namespace chainmail::test

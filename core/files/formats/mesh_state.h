#pragma once

#include "body/softness.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solver/deformer.h"

namespace chainmail {

/// Returns a view of the rest positions of a mesh; valid while the mesh exists.
inline PositionView rest_positions(const Mesh& mesh) {
  return {mesh.rest.data(), sizeof(double) * mesh.space_dimension, Precision::double_precision};
}

/// An object to write. All members must outlive the writing.
struct MeshState {
  const Mesh& mesh;
  const Cuts& cuts;
  PositionView positions;
  const Softness& softness;  // for formats that store the violation of links
};

}  // namespace chainmail

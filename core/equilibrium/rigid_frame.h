#pragma once

#include "equilibrium/link_matrix.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

/// A rigid body: the elements below a row of a coarse level.
template <int Dimension>
struct RigidFrame {
  FixedMatrix<float, Dimension> centre;
  float size = 0;  // by which rotations are divided, so that all unknowns are lengths; 0 for an element
};

/// Returns the motion of a row of `Rows` unknowns if the aggregate around it moves as a rigid body: a column for each
/// axis, then one for a rotation by 1 about each axis.
template <int Rows, int Dimension>
FixedMatrix<float, Rows, rigid_modes<Dimension>> rigid_motion(const RigidFrame<Dimension>& row,
                                                              const RigidFrame<Dimension>& aggregate) {
  FixedMatrix<float, Rows, rigid_modes<Dimension>> motion;
  for (int i = 0; i < Dimension; ++i) {
    motion(i, i) = 1;
  }
  const FixedMatrix<float, Dimension> arm = (row.centre - aggregate.centre) / aggregate.size;
  if constexpr (Dimension == 2) {
    motion(0, 2) = -arm[1];
    motion(1, 2) = arm[0];
  } else if constexpr (Dimension == 3) {
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3, last = (i + 2) % 3;
      motion(next, 3 + i) = -arm[last];
      motion(last, 3 + i) = arm[next];
    }
  }
  for (int i = Dimension; i < Rows; ++i) {
    motion(i, i) = row.size / aggregate.size;
  }
  return motion;
}

}  // namespace chainmail

#pragma once

#include <Eigen/Core>

#include "equilibrium/link_matrix.h"

namespace chainmail {

/// A rigid body: the elements below a row of a coarse level.
template <int Dimension>
struct RigidFrame {
  using Point = Eigen::Matrix<float, Dimension, 1>;

  Point centre = Point::Zero();
  float size = 0;  // by which rotations are divided, so that all unknowns are lengths; 0 for an element
};

/// Returns how a point at `arm` from the centre moves in a rotation by 1 about each axis.
template <int Dimension>
Eigen::Matrix<float, Dimension, rigid_modes<Dimension> - Dimension> rotated(
    const Eigen::Matrix<float, Dimension, 1>& arm) {
  Eigen::Matrix<float, Dimension, rigid_modes<Dimension> - Dimension> motion;
  if constexpr (Dimension == 2) {
    motion << -arm[1], arm[0];
  } else if constexpr (Dimension == 3) {
    motion << 0, arm[2], -arm[1], -arm[2], 0, arm[0], arm[1], -arm[0], 0;
  }
  return motion;
}

/// Returns the motion of a row of `Rows` unknowns if the aggregate around it moves as a rigid body.
template <int Rows, int Dimension>
Eigen::Matrix<float, Rows, rigid_modes<Dimension>> rigid_motion(const RigidFrame<Dimension>& row,
                                                                const RigidFrame<Dimension>& aggregate) {
  constexpr int rotations = rigid_modes<Dimension> - Dimension;
  Eigen::Matrix<float, Rows, rigid_modes<Dimension>> motion =
      Eigen::Matrix<float, Rows, rigid_modes<Dimension>>::Zero();
  motion.template topLeftCorner<Dimension, Dimension>().setIdentity();
  if constexpr (rotations > 0) {
    const Eigen::Matrix<float, Dimension, 1> arm = (row.centre - aggregate.centre) / aggregate.size;
    motion.template topRightCorner<Dimension, rotations>() = rotated<Dimension>(arm);
    if constexpr (Rows > Dimension) {
      motion.template bottomRightCorner<rotations, rotations>().diagonal().setConstant(row.size / aggregate.size);
    }
  }
  return motion;
}

}  // namespace chainmail

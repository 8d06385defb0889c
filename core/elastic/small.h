#pragma once

#include <Eigen/Core>

namespace chainmail {

/// A matrix and a vector of up to three rows, stored on the stack.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

}  // namespace chainmail

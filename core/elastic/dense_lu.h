#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

/// The factors L U = P A of a square matrix, in its own memory. As Eigen's, block by block, but it says how far it has
/// come and can be cancelled in between.
class DenseLu {
 public:
  DenseLu() = default;
  /// Throws Error where the matrix is singular, and Cancelled.
  explicit DenseLu(Eigen::MatrixXd&& matrix, const Progress& progress = {});

  /// Right sides as columns; answers in their place.
  void solve(Eigen::MatrixXd& columns) const;

 private:
  void factor_block(Eigen::Index first, Eigen::Index width);
  void swap_rows(Eigen::Index first, Eigen::Index width, Eigen::Index from_column, Eigen::Index columns);
  void update_rest(Eigen::Index first, Eigen::Index width, const Progress& progress);

  Eigen::MatrixXd factors_;
  std::vector<Eigen::Index> swapped_;  // step i swapped row i with this one
};

}  // namespace chainmail

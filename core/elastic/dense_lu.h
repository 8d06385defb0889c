#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/progress.h"

namespace chainmail {

/// The factors L U = P A of a square matrix, in the memory of the matrix. Works block by block, as Eigen does, but
/// reports its progress and can be cancelled.
class DenseLu {
 public:
  DenseLu() = default;
  /// Throws Error if the matrix is singular, and Cancelled.
  explicit DenseLu(Eigen::MatrixXd&& matrix, const Progress& progress = {});

  /// Replaces right sides, one per column, by the solutions.
  void solve(Eigen::MatrixXd& columns) const;

 private:
  void factor_block(Eigen::Index first, Eigen::Index width);
  void swap_rows(Eigen::Index first, Eigen::Index width, Eigen::Index from_column, Eigen::Index columns);
  void update_rest(Eigen::Index first, Eigen::Index width, const Progress& progress);

  Eigen::MatrixXd factors_;
  std::vector<Eigen::Index> swapped_;  // step i swapped row i with row swapped_[i]
};

}  // namespace chainmail

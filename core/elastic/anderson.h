#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace chainmail {

/// Anderson acceleration of a fixed-point iteration x ← x + f(x) (Peng et al. 2018): from the last steps, it
/// extrapolates to where the next step would be shortest. The limit is the same.
class Anderson {
 public:
  explicit Anderson(Eigen::Index size) : steps_(size, window), ends_(size, window) {}

  void restart() { seen_ = 0; }

  /// Returns the next iterate, from the step f(x) and its end x + f(x).
  Eigen::VectorXd next(const Eigen::VectorXd& step, const Eigen::VectorXd& end) {
    if (seen_ > 0) {
      const Eigen::Index slot = (seen_ - 1) % window;
      steps_.col(slot) = step - last_step_;
      ends_.col(slot) = end - last_end_;
    }
    last_step_ = step;
    last_end_ = end;
    const Eigen::Index used = std::min(seen_++, window);
    if (used == 0) {
      return end;
    }
    const auto changes = steps_.leftCols(used);
    Eigen::MatrixXd products = changes.transpose() * changes;
    products.diagonal() *= 1 + ridge;
    const Eigen::VectorXd shares = products.ldlt().solve(changes.transpose() * step);
    return shares.allFinite() ? Eigen::VectorXd(end - ends_.leftCols(used) * shares) : end;
  }

 private:
  static constexpr Eigen::Index window = 6;  // 5 to 8 work alike (Peng et al. 2018)
  static constexpr double ridge = 1e-12;     // steps of nearly the same direction have no unique shares

  Eigen::MatrixXd steps_, ends_;  // changes of the last steps and of their ends
  Eigen::VectorXd last_step_, last_end_;
  Eigen::Index seen_ = 0;
};

}  // namespace chainmail

#pragma once

#include <Eigen/Core>
#include <functional>

namespace chainmail::test {

/// Returns where a function is least, by the method of Broyden, Fletcher, Goldfarb and Shanno with gradients by
/// differences: slow, and without any knowledge of the function. It stops when rounding hides what it could still gain.
inline Eigen::VectorXd plain_minimum(const std::function<double(const Eigen::VectorXd&)>& energy, Eigen::VectorXd at) {
  const Eigen::Index n = at.size();
  const auto gradient_at = [&](const Eigen::VectorXd& where) {
    constexpr double step = 1e-5;
    Eigen::VectorXd gradient(n), moved = where;
    for (Eigen::Index i = 0; i < n; ++i) {
      moved[i] = where[i] + step;
      gradient[i] = energy(moved);
      moved[i] = where[i] - step;
      gradient[i] = (gradient[i] - energy(moved)) / (2 * step);
      moved[i] = where[i];
    }
    return gradient;
  };
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd gradient = gradient_at(at);
  for (int iteration = 0; iteration < 1000 && gradient.norm() > 1e-10; ++iteration) {
    const Eigen::VectorXd way = -inverse * gradient;
    const double now = energy(at);
    double share = 1;
    while (share > 1e-10 && !(energy(at + share * way) < now + 1e-4 * share * gradient.dot(way))) {
      share /= 2;
    }
    if (share <= 1e-10) {
      break;
    }
    const Eigen::VectorXd step = share * way, next = gradient_at(at + step), change = next - gradient;
    at += step;
    gradient = next;
    if (const double along = change.dot(step); along > 0) {
      const Eigen::VectorXd turned = inverse * change;
      inverse += (1 + change.dot(turned) / along) / along * step * step.transpose() -
                 (turned * step.transpose() + step * turned.transpose()) / along;
    }
  }
  return at;
}

}  // namespace chainmail::test

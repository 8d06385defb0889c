#include "elastic/elastic.h"

namespace chainmail {

ElasticMotion ElasticMotion::by(std::span<const double> translation) {
  const auto n = static_cast<Eigen::Index>(translation.size());
  return {SmallMatrix::Zero(n, n), Eigen::Map<const Eigen::VectorXd>(translation.data(), n)};
}

SmallVector displacement_of(const ElasticHandle& handle, std::size_t i, const ElasticMotion& motion) {
  if (handle.elements.size() == 1) {
    return motion.translation;
  }
  const Eigen::Index n = motion.translation.size();
  const auto of = [&](const std::vector<double>& all) {
    return Eigen::Map<const Eigen::VectorXd>(all.data() + static_cast<Eigen::Index>(i) * n, n);
  };
  const SmallVector turned = motion.turn * of(handle.arms);
  return of(handle.displacements) + turned + motion.translation;
}

}  // namespace chainmail

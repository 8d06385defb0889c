#include "elastic/bernstein.h"

namespace chainmail {
namespace {

/// Returns all Bernstein polynomials of one degree at t in [0, 1], by their recurrence.
Eigen::VectorXd polynomials(int count, double t) {
  Eigen::VectorXd values = Eigen::VectorXd::Unit(count, 0);
  for (int degree = 1; degree < count; ++degree) {
    for (int i = degree; i > 0; --i) {
      values[i] = (1 - t) * values[i] + t * values[i - 1];
    }
    values[0] *= 1 - t;
  }
  return values;
}

}  // namespace

BernsteinVolume::BernsteinVolume(const Mesh& mesh, const std::array<std::uint32_t, 3>& counts) : mesh_(mesh) {
  for (int k = 0; k < mesh.space_dimension; ++k) {
    counts_.push_back(static_cast<int>(counts[static_cast<std::size_t>(mesh.axes[k])]));
    count_ *= counts_.back();
  }
}

Eigen::VectorXd BernsteinVolume::rest(Eigen::Index point) const {
  Eigen::VectorXd at(mesh_.space_dimension);
  for (int k = 0; k < mesh_.space_dimension; ++k) {
    const double low = mesh_.box[0][mesh_.axes[k]], high = mesh_.box[1][mesh_.axes[k]];
    at[k] = low + (high - low) * double(point % counts_[k]) / (counts_[k] - 1);
    point /= counts_[k];
  }
  return at;
}

Eigen::VectorXd BernsteinVolume::weights(ElementId element) const {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(1);
  for (int k = 0; k < mesh_.space_dimension; ++k) {
    const double low = mesh_.box[0][mesh_.axes[k]], high = mesh_.box[1][mesh_.axes[k]];
    const double at =
        mesh_
            .rest[std::size_t{element} * static_cast<std::size_t>(mesh_.space_dimension) + static_cast<std::size_t>(k)];
    const double share = high > low ? (at - low) / (high - low) : 0;
    all = Eigen::VectorXd((all * polynomials(counts_[k], share).transpose()).reshaped());
  }
  return all;
}

}  // namespace chainmail

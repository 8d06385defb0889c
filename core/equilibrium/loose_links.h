#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/fixed_matrix.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The links of elements that no cell holds any more: springs of their rest lengths, so weak that the cells do not feel
/// them.
template <int Dimension>
class LooseLinks {
 public:
  using Vector = FixedMatrix<double, Dimension>;
  using Vectors = std::vector<Vector>;
  static constexpr double stiffness = 1e-6;

  /// Finds the uncut links with an end that no cell holds. `cells_beside`: the number of whole cells of each element.
  void find(const Mesh& mesh, const Cuts& cuts, const std::vector<std::uint32_t>& cells_beside) {
    links_.clear();
    lengths_.clear();
    for (LinkId link = 0; link < mesh.link_count(); ++link) {
      const auto [i, j] = mesh.links[link];
      if ((cells_beside[i] == 0 || cells_beside[j] == 0) && !cuts.is_cut(link)) {
        links_.push_back(link);
        lengths_.push_back(rest_length(mesh, link));
      }
    }
  }
  /// The same after these links (ascending, each once) were cut or restored, or the cells beside their ends.
  void update(const Mesh& mesh, const Cuts& cuts, const std::vector<std::uint32_t>& cells_beside,
              std::span<const LinkId> changed) {
    std::vector<LinkId> others, now;
    std::ranges::set_difference(links_, changed, std::back_inserter(others));
    const auto is_loose = [&](LinkId link) {
      const auto [i, j] = mesh.links[link];
      return (cells_beside[i] == 0 || cells_beside[j] == 0) && !cuts.is_cut(link);
    };
    std::ranges::copy_if(changed, std::back_inserter(now), is_loose);
    links_.clear();
    std::ranges::merge(others, now, std::back_inserter(links_));
    lengths_.clear();
    for (const LinkId link : links_) {
      lengths_.push_back(rest_length(mesh, link));
    }
  }
  std::span<const LinkId> links() const { return links_; }

  /// Returns their energy at these displacements from rest (mesh units), and adds its negative gradient, if given; both
  /// times `factor`.
  double add(const Mesh& mesh, const Vectors& displacements, Vectors* force, double factor = 1) const {
    double energy = 0;
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const auto [i, j] = mesh.links[links_[k]];
      Vector apart = displacements[j] - displacements[i];
      for (int axis = 0; axis < Dimension; ++axis) {
        apart[axis] += mesh.rest[std::size_t{j} * Dimension + std::size_t(axis)] -
                       mesh.rest[std::size_t{i} * Dimension + std::size_t(axis)];
      }
      const double length = apart.norm(), longer = length - lengths_[k];
      energy += factor * stiffness * longer * longer / 2;
      if (force != nullptr && length > 0) {
        const Vector pull = factor * stiffness * longer / length * apart;
        (*force)[i] += pull;
        (*force)[j] -= pull;
      }
    }
    return energy;
  }

 private:
  std::vector<LinkId> links_;
  std::vector<double> lengths_;  // at rest (mesh units)
};

}  // namespace chainmail

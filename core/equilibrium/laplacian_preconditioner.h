#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "equilibrium/block_vectors.h"
#include "equilibrium/multigrid.h"

namespace chainmail {

/// The weighted Laplacian of the links with its multigrid, which is brought up to date when it is used. It serves all
/// axes at once.
template <int D>
class LaplacianPreconditioner {
 public:
  using Vectors = BlockVectors<double, D>;

  void begin(MeshPointer mesh) {
    matrix_ = finest_ = Matrix(std::move(mesh));
    grid_ = {};
    outdated_.clear();
    changed_.clear();
    cut_ = are_all_outdated_ = false;
  }
  const Mesh& mesh() const { return matrix_.mesh(); }
  bool is_fixed(ElementId element) const { return matrix_.is_fixed(element); }

  void set_link(LinkId link, double weight) {
    matrix_.set_link(link, static_cast<float>(weight));
    finest_.set_link(link, static_cast<float>(weight));
    const auto [i, j] = mesh().links[link];
    outdated_.insert(outdated_.end(), {i, j});
    cut_ = cut_ || weight == 0;
  }
  /// The same for all links.
  void set_links(std::span<const double> weights) {
    for (LinkId link = 0; link < weights.size(); ++link) {
      matrix_.set_link(link, static_cast<float>(weights[link]));
      finest_.set_link(link, static_cast<float>(weights[link]));
    }
    are_all_outdated_ = true;
  }
  /// The same for a while: the coarser levels keep the weight of before.
  void set_link_for_a_while(LinkId link, double weight) {
    finest_.set_link(link, static_cast<float>(weight));
    const auto [i, j] = mesh().links[link];
    changed_.insert(changed_.end(), {i, j});
  }
  void set_fixed(ElementId element, bool fixed) {
    matrix_.set_fixed(element, fixed);
    finest_.set_fixed(element, fixed);
    outdated_.push_back(element);
    const auto neighbours = mesh().neighbours_of(element);
    outdated_.insert(outdated_.end(), neighbours.begin(), neighbours.end());
  }

  /// Returns true if it built a multigrid.
  bool update(const Progress& progress) {
    std::ranges::sort(outdated_);
    outdated_.erase(std::unique(outdated_.begin(), outdated_.end()), outdated_.end());
    const bool builds = !grid_.is_built() || are_all_outdated_ || outdated_.size() > matrix_.size() / 2;
    if (builds) {
      grid_.build(matrix_, progress);
    } else if (!outdated_.empty()) {
      grid_.update(matrix_, outdated_, cut_);
    }
    changed_.insert(changed_.end(), outdated_.begin(), outdated_.end());
    if (builds) {
      changed_.resize(matrix_.size());
      std::iota(changed_.begin(), changed_.end(), ElementId{0});
    }
    grid_.update_finest(finest_, changed_);
    outdated_.clear();
    changed_.clear();
    cut_ = are_all_outdated_ = false;
    return builds;
  }

  void apply(const Vectors& right, Vectors& result, const SharedLoop& shared) {
    const double largest = shared.largest(right.size(), [&](std::size_t first, std::size_t last) {
      double most = 0;
      for (std::size_t i = first; i < last; ++i) {
        most = std::max(most, right[i].largest());
      }
      return most;
    });
    const double scale = largest > 0 ? 1 / largest : 1;
    right_.resize(right.size());
    shared.run(right.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        for (int k = 0; k < D; ++k) {
          right_[i][k] = float(right[i][k] * scale);
        }
      }
    });
    grid_.cycle(finest_, right_, result_, shared);
    result.resize(right.size());
    shared.run(right.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        for (int k = 0; k < D; ++k) {
          result[i][k] = double(result_[i][k]) / scale;
        }
      }
    });
  }

 private:
  // Four numbers are one register, three are not.
  using Matrix = LinkLaplacian<D == 3 ? 4 : D>;

  Matrix matrix_;  // of which the coarser levels are made
  Matrix finest_;  // the same, with the links that were set for a while
  Multigrid<Matrix> grid_;
  std::vector<ElementId> outdated_;  // rows
  std::vector<ElementId> changed_;   // rows of which the finest level is outdated
  bool are_all_outdated_ = false;
  bool cut_ = false;
  typename Matrix::Vectors right_, result_;
};

}  // namespace chainmail

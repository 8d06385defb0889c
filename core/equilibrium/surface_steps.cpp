#include "equilibrium/surface_steps.h"

#include <algorithm>

#include "elastic/elimination.h"

namespace chainmail {
namespace {

/// The stencils of a surface as simplices, which dissection keeps together: its hinges, and triangles without a hinge.
Simplices stencils_of(const SurfaceCells& cells) {
  Simplices result;
  result.dimension = 3;
  for (const auto& hinge : cells.hinges) {
    result.corners.insert(result.corners.end(), hinge.corners.begin(), hinge.corners.end());
  }
  for (const auto& [a, b, c] : cells.triangles) {
    result.corners.insert(result.corners.end(), {a, b, c, c});
  }
  return result;
}

}  // namespace

void SurfaceInverse::begin(const SurfaceEnergy& energy, const Progress& progress) {
  progress.report(0);
  is_fixed_.assign(energy.mesh().element_count(), 0);
  order_ = dissect(stencils_of(energy.cells()), energy.mesh());
  place_.assign(energy.mesh().element_count(), no_element);
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    place_[order_[i]] = i;
  }
  for (ElementId e = 0; e < place_.size(); ++e) {  // those without a triangle
    if (place_[e] == no_element) {
      place_[e] = std::uint32_t(order_.size());
      order_.push_back(e);
    }
  }
  find_pattern(energy);
  make_matrix();
  factor_.analyze(matrix_);
}

void SurfaceInverse::find_pattern(const SurfaceEnergy& energy) {
  std::vector<std::array<std::uint32_t, 2>> pairs;  // column, row
  const auto add_pairs = [&](const auto& corners) {
    for (const ElementId a : corners) {
      for (const ElementId b : corners) {
        if (place_[a] <= place_[b]) {
          pairs.push_back({place_[a], place_[b]});
        }
      }
    }
  };
  for (const auto& hinge : energy.cells().hinges) {
    add_pairs(hinge.corners);
  }
  for (const auto& triangle : energy.cells().triangles) {
    add_pairs(triangle);
  }
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    pairs.push_back({i, i});
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_block_.assign(order_.size() + 1, 0);
  block_row_.clear();
  for (const auto& [column, row] : pairs) {
    ++first_block_[column + 1];
    block_row_.push_back(row);
  }
  for (std::size_t i = 0; i < order_.size(); ++i) {
    first_block_[i + 1] += first_block_[i];
  }
  blocks_.assign(block_row_.size(), Square());
}

/// Makes the matrix of these blocks, all 0.
void SurfaceInverse::make_matrix() {
  const auto size = Eigen::Index(3 * order_.size());
  matrix_.resize(size, size);
  matrix_.reserve(Eigen::Index(9 * block_row_.size()));
  for (std::uint32_t column = 0; column < order_.size(); ++column) {
    for (int j = 0; j < 3; ++j) {
      matrix_.startVec(3 * Eigen::Index{column} + j);
      for (std::uint32_t block = first_block_[column]; block < first_block_[column + 1]; ++block) {
        for (int i = block_row_[block] == column ? j : 0; i < 3; ++i) {
          matrix_.insertBack(3 * Eigen::Index{block_row_[block]} + i, 3 * Eigen::Index{column} + j) = 0;
        }
      }
    }
  }
  matrix_.finalize();
}

std::uint32_t SurfaceInverse::find_block(std::uint32_t row, std::uint32_t column) const {
  const auto first = block_row_.begin() + first_block_[column], last = block_row_.begin() + first_block_[column + 1];
  return std::uint32_t(std::lower_bound(first, last, row) - block_row_.begin());
}

/// `matrix`: a block per pair of corners.
template <class Corners, class Matrix>
void SurfaceInverse::add(const Corners& corners, const Matrix& matrix) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    for (std::size_t l = 0; l < corners.size(); ++l) {
      const std::uint32_t row = place_[corners[k]], column = place_[corners[l]];
      if (row >= column && is_fixed_[corners[k]] == 0 && is_fixed_[corners[l]] == 0) {
        Square& block = blocks_[find_block(row, column)];
        for (int i = 0; i < 9; ++i) {
          block[i] += matrix(3 * int(k) + i % 3, 3 * int(l) + i / 3);
        }
      }
    }
  }
}

void SurfaceInverse::assemble(const SurfaceEnergy& energy, const RegionPenalties<3>& regions, const Vectors& at,
                              const Progress& progress) {
  std::ranges::fill(blocks_, Square());
  const SurfaceCells& cells = energy.cells();
  for (std::uint32_t t = 0; t < cells.triangles.size(); ++t) {
    progress.report(t, cells.triangles.size());
    if (energy.is_whole(t)) {
      add(cells.triangles[t], energy.curvature_of_triangle(t, at));
    }
  }
  for (std::size_t h = 0; h < cells.hinges.size(); ++h) {
    const SurfaceEnergy::HingeVector one = energy.curvature_of_hinge(h, at);
    if (!one.isZero()) {
      add(cells.hinges[h].corners, outer_product(one, one));
    }
  }
  // Springs count at their ends only, which is at most twice as stiff: the pattern does not have all links.
  for (const LinkId link : energy.loose_links()) {
    for (const ElementId e : energy.mesh().links[link]) {
      add_to_diagonal(e, LooseLinks<3>::stiffness);
    }
  }
  regions.for_each_spring([&](ElementId i, ElementId j, double stiffness) {
    add_to_diagonal(i, stiffness);
    add_to_diagonal(j, stiffness);
  });
}

void SurfaceInverse::write_matrix(double added) {
  double* value = matrix_.valuePtr();
  for (std::uint32_t column = 0; column < order_.size(); ++column) {
    for (int j = 0; j < 3; ++j) {
      for (std::uint32_t block = first_block_[column]; block < first_block_[column + 1]; ++block) {
        const bool is_diagonal = block_row_[block] == column;
        for (int i = is_diagonal ? j : 0; i < 3; ++i) {
          *value++ = blocks_[block](i, j) + (is_diagonal && i == j ? added : 0);
        }
      }
    }
  }
}

void SurfaceInverse::factor(const SurfaceEnergy& energy, const RegionPenalties<3>& regions, const Vectors& at,
                            const std::function<bool(ElementId)>& is_fixed, const Progress& progress) {
  for (ElementId e = 0; e < is_fixed_.size(); ++e) {
    is_fixed_[e] = is_fixed(e) ? 1 : 0;
  }
  assemble(energy, regions, at, progress.part(0, 0.2));
  double mean = 0;
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    mean += blocks_[first_block_[i]].trace() / double(3 * order_.size());
  }
  mean = mean > 0 ? mean : 1;
  for (ElementId e = 0; e < is_fixed_.size(); ++e) {
    if (is_fixed_[e] != 0) {
      blocks_[first_block_[place_[e]]] = mean * Square::Identity();
    }
  }
  // A part that nothing holds has no stiffness against rigid motions.
  double added = 1e-13 * mean;
  for (write_matrix(added); !factor_.factor(matrix_, progress.part(0.2, 1)); write_matrix(added)) {
    added *= 100;
  }
}

void SurfaceInverse::apply(const Vectors& right, Vectors& result, const SharedLoop& /*shared*/) const {
  Eigen::MatrixXd all(Eigen::Index(3 * order_.size()), 1);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    std::copy_n(right[order_[i]].data(), 3, all.data() + 3 * i);
  }
  all = factor_.solve(std::move(all));
  result.resize(right.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    std::copy_n(all.data() + 3 * i, 3, result[order_[i]].data());
  }
}

namespace {

// Factors take as long as 5 to 20 steps, and serve at least these steps. They are computed anew when a step leaves more
// than this share of the distance. Measured on sheets of 17 x 17 to 65 x 65 elements: with 2 steps there are as many
// steps and twice as many factors.
constexpr int fewest_steps = 5;
constexpr double little_gain = 0.5;

}  // namespace

void SurfaceSteps::begin(const SurfaceEnergy& energy, const Progress& progress) {
  can_factor_ = energy.mesh().element_count() <= max_factored;
  if (can_factor_) {
    inverse_.begin(energy, progress);
  }
  forget();
}

void SurfaceSteps::forget() {
  newton_.forget();
  is_outdated_ = true;
}

void SurfaceSteps::factor(const SurfaceEnergy& energy, const LaplacianPreconditioner<3>& laplacian,
                          const RegionPenalties<3>& regions, const Vectors& at, const Progress& progress) {
  inverse_.factor(
      energy, regions, at, [&](ElementId e) { return laplacian.is_fixed(e); }, progress);
  newton_.forget();
  is_outdated_ = false;
  has_prepared_ = true;
  steps_ = 0;
}

void SurfaceSteps::note_step() {
  const double distance = newton_.distance();
  is_outdated_ = ++steps_ >= fewest_steps && distance > little_gain * last_distance_;
  last_distance_ = distance;
}

}  // namespace chainmail

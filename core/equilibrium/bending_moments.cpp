#include "equilibrium/bending_moments.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

// The polynomial is this close to the inverse, relative, where the eigenvalues are above the lowest one considered.
// Slivers have lower ones: there it is softer.
constexpr double wanted_accuracy = 1e-4;
constexpr double lowest_eigenvalue = 0.05;

/// Returns the moments in a triangle whose normal component is 1 on one side and 0 on the others, for each side, from
/// the directions of the sides.
std::array<Eigen::Matrix2d, 3> moments_of(const std::array<Eigen::Vector2d, 3>& along) {
  std::array<Eigen::Matrix2d, 3> moments;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d &one = along[(k + 1) % 3], &other = along[(k + 2) % 3];
    const Eigen::Vector2d normal(-along[k].y(), along[k].x());
    const Eigen::Matrix2d product = one * other.transpose();
    moments[k] = (product + product.transpose()) / (2 * one.dot(normal) * other.dot(normal));
  }
  return moments;
}

}  // namespace

void BendingMoments::build(const Mesh& mesh, const SurfaceCells& cells) {
  products_.resize(cells.triangles.size());
  traces_.resize(cells.triangles.size());
  for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
    const Point a = mesh.rest_position(cells.triangles[t][0]), b = mesh.rest_position(cells.triangles[t][1]) - a,
                c = mesh.rest_position(cells.triangles[t][2]) - a;
    const double width = b.norm(), foot = c.dot(b) / width, height = b.cross(c).norm() / width;
    const auto moments = moments_of({Eigen::Vector2d(1, 0), Eigen::Vector2d(foot - width, height).normalized(),
                                     Eigen::Vector2d(-foot, -height).normalized()});
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; l < 3; ++l) {
        const double area = width * height / 2;
        products_[t](Eigen::Index(k), Eigen::Index(l)) = area * moments[k].cwiseProduct(moments[l]).sum();
        traces_[t](Eigen::Index(k), Eigen::Index(l)) = area * moments[k].trace() * moments[l].trace();
      }
    }
  }
  lengths_.clear();
  for (const auto& hinge : cells.hinges) {
    lengths_.push_back((mesh.rest_position(hinge.corners[1]) - mesh.rest_position(hinge.corners[0])).norm());
  }
  find_corners(cells);
  find_columns(cells);
  values_.assign(columns_.size(), 0);
  diagonal_.assign(cells.hinges.size(), 0);
}

void BendingMoments::find_corners(const SurfaceCells& cells) {
  first_corner_.assign(cells.triangles.size() + 1, 0);
  for (const auto& hinge : cells.hinges) {
    ++first_corner_[hinge.triangle[0] + 1];
    ++first_corner_[hinge.triangle[1] + 1];
  }
  for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
    first_corner_[t + 1] += first_corner_[t];
  }
  corners_.resize(first_corner_.back());
  std::vector<std::uint32_t> next(first_corner_.begin(), first_corner_.end() - 1);
  for (std::uint32_t h = 0; h < cells.hinges.size(); ++h) {
    const auto& hinge = cells.hinges[h];
    corners_[next[hinge.triangle[0]]++] = {h, hinge.side[0], 1};
    corners_[next[hinge.triangle[1]]++] = {h, hinge.side[1], std::int8_t(hinge.agrees ? 1 : -1)};
  }
}

void BendingMoments::find_columns(const SurfaceCells& cells) {
  first_entry_.assign(1, 0);
  columns_.clear();
  for (std::uint32_t h = 0; h < cells.hinges.size(); ++h) {
    for (const std::uint32_t triangle : cells.hinges[h].triangle) {
      for (const Corner& corner : hinges_of(triangle)) {
        if (corner.hinge != h) {
          columns_.push_back(corner.hinge);
        }
      }
    }
    const auto begin = columns_.begin() + first_entry_.back();
    std::sort(begin, columns_.end());
    columns_.erase(std::unique(begin, columns_.end()), columns_.end());
    first_entry_.push_back(std::uint32_t(columns_.size()));
  }
}

void BendingMoments::set(const SurfaceCells& cells, double poisson, std::span<const std::uint8_t> is_whole) {
  poisson_ = poisson;
  for (std::uint32_t h = 0; h < diagonal_.size(); ++h) {
    find_row(cells, h, is_whole);
  }
  find_degree();
}

void BendingMoments::update(const SurfaceCells& cells, std::span<const std::uint8_t> is_whole,
                            std::span<const std::uint32_t> changed) {
  for (const std::uint32_t triangle : changed) {
    for (const Corner& corner : hinges_of(triangle)) {
      for (const std::uint32_t beside : cells.hinges[corner.hinge].triangle) {
        for (const Corner& row : hinges_of(beside)) {
          find_row(cells, row.hinge, is_whole);
        }
      }
    }
  }
}

/// Returns the energy of the moments of a triangle's sides, as a quadratic form: that of the plate's material,
/// (M : M − ν/(1 + ν) (tr M)²) / (1 − ν), times the area.
Eigen::Matrix3d BendingMoments::compliance(std::uint32_t triangle) const {
  return (products_[triangle] - poisson_ / (1 + poisson_) * traces_[triangle]) / (1 - poisson_);
}

void BendingMoments::find_row(const SurfaceCells& cells, std::uint32_t hinge, std::span<const std::uint8_t> is_whole) {
  const auto is_there = [&](std::uint32_t one) {
    const auto& beside = cells.hinges[one].triangle;
    return is_whole[beside[0]] != 0 && is_whole[beside[1]] != 0;
  };
  const auto first = columns_.begin() + first_entry_[hinge], last = columns_.begin() + first_entry_[hinge + 1];
  std::fill(values_.begin() + first_entry_[hinge], values_.begin() + first_entry_[hinge + 1], 0);
  diagonal_[hinge] = 0;
  if (!is_there(hinge)) {
    return;
  }
  for (const std::uint32_t triangle : cells.hinges[hinge].triangle) {
    const Eigen::Matrix3d all = compliance(triangle);
    const auto beside = hinges_of(triangle);
    const auto own = std::ranges::find(beside, hinge, &Corner::hinge);
    for (const Corner& other : beside) {
      const double value = own->sign * other.sign * all(own->side, other.side);
      if (other.hinge == hinge) {
        diagonal_[hinge] += value;
      } else if (is_there(other.hinge)) {
        values_[std::size_t(std::lower_bound(first, last, other.hinge) - columns_.begin())] += value;
      }
    }
  }
}

/// The eigenvalues of each triangle's part bound those of the whole (Irons and Treharne 1971).
void BendingMoments::find_degree() {
  low_ = 1;
  high_ = 1;
  for (std::uint32_t t = 0; t < products_.size(); ++t) {
    const Eigen::Matrix3d all = compliance(t);
    const Eigen::Vector3d scale = all.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Matrix3d scaled = scale.asDiagonal() * all * scale.asDiagonal();
    const Eigen::Vector3d values =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
    low_ = std::min(low_, values[0]);
    high_ = std::max(high_, values[2]);
  }
  low_ = std::max(low_, lowest_eigenvalue);
  const double root = std::sqrt(high_ / low_), rate = (root - 1) / (root + 1);
  degree_ = rate > 0 ? std::max(1, int(std::ceil(std::log(wanted_accuracy / 2) / std::log(rate)))) : 1;
}

/// Chebyshev's iteration from 0, with the diagonal as preconditioner: a polynomial that does not depend on b.
void BendingMoments::solve(const std::vector<double>& b, std::vector<double>& moments, const SharedLoop& shared) {
  const std::size_t count = diagonal_.size();
  moments.assign(count, 0);
  direction_.assign(count, 0);
  residual_ = b;
  const double middle = (high_ + low_) / 2, half = (high_ - low_) / 2;
  double alpha = 0;
  for (int turn = 0; turn < degree_; ++turn) {
    const double beta = (turn == 1 ? 0.5 : 0.25) * half * half * alpha * alpha;
    alpha = turn == 0 ? 1 / middle : 1 / (middle - beta / alpha);
    shared.run(count, [&](std::size_t first, std::size_t last) {
      for (std::size_t h = first; h < last; ++h) {
        direction_[h] = (diagonal_[h] > 0 ? residual_[h] / diagonal_[h] : 0) + beta * direction_[h];
        moments[h] += alpha * direction_[h];
      }
    });
    if (turn + 1 < degree_) {
      find_residual(b, moments, shared);
    }
  }
}

void BendingMoments::find_residual(const std::vector<double>& b, const std::vector<double>& moments,
                                   const SharedLoop& shared) {
  shared.run(b.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t h = first; h < last; ++h) {
      double sum = b[h] - diagonal_[h] * moments[h];
      for (std::uint32_t i = first_entry_[h]; i < first_entry_[h + 1]; ++i) {
        sum -= values_[i] * moments[columns_[i]];
      }
      residual_[h] = sum;
    }
  });
}

}  // namespace chainmail

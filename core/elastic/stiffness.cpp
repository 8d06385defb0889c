#include "elastic/stiffness.h"

#include <algorithm>

namespace chainmail {

Unknowns::Unknowns(int dimension, ElementId elements, std::span<const ElementId> elimination,
                   std::span<const ElementId> prescribed)
    : dimension_(dimension), first_(elements, none) {
  std::vector<bool> is_prescribed(elements, false);
  for (const ElementId element : prescribed) {
    is_prescribed[element] = true;
  }
  for (const ElementId element : elimination) {
    if (!is_prescribed[element]) {
      first_[element] = static_cast<std::int32_t>(count_);
      count_ += dimension_;
    }
  }
}

Eigen::VectorXd Unknowns::gather(const std::vector<double>& all) const {
  Eigen::VectorXd unknown(count_);
  for (std::size_t e = 0; e < first_.size(); ++e) {
    if (first_[e] != none) {
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(e) * dimension_, dimension_, unknown.data() + first_[e]);
    }
  }
  return unknown;
}

void Unknowns::scatter(const Eigen::VectorXd& unknown, std::vector<double>& all) const {
  for (std::size_t e = 0; e < first_.size(); ++e) {
    if (first_[e] != none) {
      std::copy_n(unknown.data() + first_[e], dimension_, all.begin() + static_cast<std::ptrdiff_t>(e) * dimension_);
    }
  }
}

void Unknowns::scatter(const Eigen::MatrixXd& unknown, Eigen::Ref<Eigen::MatrixXd> all) const {
  for (std::size_t e = 0; e < first_.size(); ++e) {
    if (first_[e] != none) {
      all.middleRows(static_cast<Eigen::Index>(e) * dimension_, dimension_) = unknown.middleRows(first_[e], dimension_);
    }
  }
}

namespace {

constexpr std::size_t max_corner_coordinates = 12;  // of a tetrahedron

/// Returns the unknown of each coordinate of the corners of a simplex, or none.
std::array<std::int32_t, max_corner_coordinates> unknowns_of(const Simplices& simplices, std::size_t simplex,
                                                             const Unknowns& unknowns) {
  std::array<std::int32_t, max_corner_coordinates> all{};
  const auto n = static_cast<std::size_t>(simplices.dimension);
  const auto corners = simplices.corners_of(simplex);
  for (std::size_t i = 0; i < n * (n + 1); ++i) {
    const std::int32_t first = unknowns.of(corners[i / n]);
    all[i] = first == Unknowns::none ? Unknowns::none : first + static_cast<std::int32_t>(i % n);
  }
  return all;
}

/// Calls visit(index among all entries, row, column) for each entry of each simplex that is in the lower triangle.
template <class Visit>
void for_each_entry(const Simplices& simplices, const Unknowns& unknowns, Visit visit) {
  const auto n = static_cast<std::size_t>(simplices.dimension);
  const std::size_t width = n * (n + 1);
  for (std::size_t s = 0; s < simplices.count(); ++s) {
    const auto all = unknowns_of(simplices, s, unknowns);
    for (std::size_t j = 0; j < width; ++j) {
      for (std::size_t i = 0; i < width; ++i) {
        if (all[i] != Unknowns::none && all[j] != Unknowns::none && all[i] >= all[j]) {
          visit((s * width + j) * width + i, all[i], all[j]);
        }
      }
    }
  }
}

}  // namespace

Stiffness::Stiffness(const Simplices& simplices, const Unknowns& unknowns, const Progress& progress)
    : simplices_(simplices), unknowns_(unknowns), matrix_(unknowns.count(), unknowns.count()) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto n = static_cast<std::size_t>(simplices.dimension);
  const std::size_t count = simplices.count() * n * (n + 1) * n * (n + 1);
  const Progress collecting = progress.part(0, 0.3),
                 finding = progress.part(0.6, 1);  // setFromTriplets does not report
  for_each_entry(simplices, unknowns, [&](std::size_t entry, std::int32_t row, std::int32_t column) {
    collecting.report(entry, count);
    entries.emplace_back(row, column, 0);
  });
  progress.report(0.3);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  entries = {};
  indices_.assign(count, Unknowns::none);
  for_each_entry(simplices, unknowns, [&](std::size_t entry, std::int32_t row, std::int32_t column) {
    finding.report(entry, count);
    const auto* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    const auto* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    indices_[entry] = static_cast<std::int32_t>(std::lower_bound(begin, end, row) - matrix_.innerIndexPtr());
  });
}

void Stiffness::clear() { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0); }

void Stiffness::add(std::size_t simplex, const CornerMatrix& stiffness) {
  const auto width = static_cast<std::size_t>(stiffness.rows());
  const std::int32_t* index = indices_.data() + simplex * width * width;
  for (const double value : stiffness.reshaped()) {
    if (*index != Unknowns::none) {
      matrix_.valuePtr()[*index] += value;
    }
    ++index;
  }
}

void Stiffness::clear(const std::vector<bool>& columns) {
  for (Eigen::Index column = 0; column < matrix_.cols(); ++column) {
    if (columns[static_cast<std::size_t>(column)]) {
      std::fill(matrix_.valuePtr() + matrix_.outerIndexPtr()[column],
                matrix_.valuePtr() + matrix_.outerIndexPtr()[column + 1], 0.0);
    }
  }
}

void Stiffness::add(std::size_t simplex, const CornerMatrix& stiffness, const std::vector<bool>& columns) {
  const auto width = static_cast<std::size_t>(stiffness.rows());
  const auto all = unknowns_of(simplices_, simplex, unknowns_);
  for (std::size_t j = 0; j < width; ++j) {
    if (all[j] == Unknowns::none || !columns[static_cast<std::size_t>(all[j])]) {
      continue;
    }
    const std::int32_t* index = indices_.data() + (simplex * width + j) * width;
    for (std::size_t i = 0; i < width; ++i) {
      if (index[i] != Unknowns::none) {
        matrix_.valuePtr()[index[i]] += stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
}

}  // namespace chainmail

#include "elastic/cholesky.h"

#include <algorithm>

#include "elastic/dense.h"

namespace chainmail {
namespace {

// Columns join a supernode although their rows differ by up to this many: a few zeros cost less than another small
// block.
constexpr int max_zeros = 8;

// Columns of a front between two progress reports: a few tenths of a second at most.
constexpr Eigen::Index columns_at_once = 128;
constexpr Eigen::Index columns_subtracted = 512;  // of what remains of a front, between two progress reports

constexpr int none = -1;

/// The parent of each column in the elimination tree, and the number of rows of each column of the factor (Liu 1990).
struct Columns {
  explicit Columns(const Cholesky::Sparse& lower)
      : parent(static_cast<std::size_t>(lower.cols()), none), length(parent.size(), 1) {
    const Cholesky::Sparse rows = lower.transpose();  // row i of the lower triangle is a column here
    std::vector<int> seen(parent.size(), none);
    for (int row = 0; row < rows.cols(); ++row) {
      seen[static_cast<std::size_t>(row)] = row;
      for (Cholesky::Sparse::InnerIterator one(rows, row); one; ++one) {
        for (auto i = static_cast<std::size_t>(one.row()); static_cast<int>(i) < row && seen[i] != row;
             i = static_cast<std::size_t>(parent[i])) {
          parent[i] = parent[i] == none ? row : parent[i];
          ++length[i];
          seen[i] = row;
        }
      }
    }
  }

  std::vector<int> parent, length;
};

}  // namespace

void Cholesky::analyze(const Sparse& lower) {
  supernodes_.clear();
  find_supernodes(lower);
  front_rows_.assign(static_cast<std::size_t>(lower.cols()), none);
  find_rows(lower);
  std::size_t size = 0;
  for (Supernode& one : supernodes_) {
    one.panel = size;
    size += one.rows.size() * static_cast<std::size_t>(one.width);
  }
  panels_.assign(size, 0);
  updates_.assign(supernodes_.size(), {});
  has_factors_ = has_updates_ = false;
}

void Cholesky::drop_updates() {
  keeps_ = has_updates_ = false;
  updates_.assign(supernodes_.size(), {});
}

std::size_t Cholesky::update_count() const {
  std::size_t count = 0;
  for (const Supernode& one : supernodes_) {
    const auto below = static_cast<std::size_t>(one.height() - one.width);
    count += below * (below + 1) / 2;
  }
  return count;
}

void Cholesky::find_supernodes(const Sparse& lower) {
  const Columns columns(lower);
  for (std::size_t j = 0; j < columns.parent.size(); ++j) {
    const bool joins = j > 0 && columns.parent[j - 1] == static_cast<int>(j) &&
                       columns.length[j] + 1 - columns.length[j - 1] <= max_zeros;
    if (!joins) {
      supernodes_.push_back({static_cast<int>(j), 0, {}, {}, 0});
    }
    ++supernodes_.back().width;
  }
}

/// Finds the rows of each supernode: the rows of its columns in the matrix, and those passed on by its children.
void Cholesky::find_rows(const Sparse& lower) {
  std::vector<std::size_t> of_column(static_cast<std::size_t>(lower.cols()));
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    std::fill_n(of_column.begin() + supernodes_[s].first, supernodes_[s].width, s);
  }
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    Supernode& one = supernodes_[s];
    const auto add = [&](int row) {
      if (front_rows_[static_cast<std::size_t>(row)] != static_cast<int>(s)) {
        front_rows_[static_cast<std::size_t>(row)] = static_cast<int>(s);
        one.rows.push_back(row);
      }
    };
    for (int column = one.first; column < one.first + one.width; ++column) {
      add(column);
    }
    for (int column = one.first; column < one.first + one.width; ++column) {
      for (Sparse::InnerIterator entry(lower, column); entry; ++entry) {
        add(static_cast<int>(entry.row()));
      }
    }
    for (const std::size_t child : one.children) {
      const Supernode& below = supernodes_[child];
      std::for_each(below.rows.begin() + below.width, below.rows.end(), add);
    }
    std::ranges::sort(one.rows);
    if (one.height() > one.width) {
      supernodes_[of_column[static_cast<std::size_t>(one.rows[static_cast<std::size_t>(one.width)])]]
          .children.push_back(s);
    }
  }
}

/// Returns the lower triangle of the front of a supernode before elimination: its columns of the matrix plus the
/// updates of its children.
Eigen::MatrixXd Cholesky::front_of(const Supernode& supernode, const Sparse& lower) {
  Eigen::MatrixXd front = Eigen::MatrixXd::Zero(supernode.height(), supernode.height());
  for (int i = 0; i < supernode.height(); ++i) {
    front_rows_[static_cast<std::size_t>(supernode.rows[static_cast<std::size_t>(i)])] = i;
  }
  const auto front_row = [this](int row) { return front_rows_[static_cast<std::size_t>(row)]; };
  for (int column = 0; column < supernode.width; ++column) {
    for (Sparse::InnerIterator entry(lower, supernode.first + column); entry; ++entry) {
      front(front_row(static_cast<int>(entry.row())), column) += entry.value();
    }
  }
  std::vector<int> to;
  for (const std::size_t child : supernode.children) {
    const Supernode& below = supernodes_[child];
    to.clear();
    std::transform(below.rows.begin() + below.width, below.rows.end(), std::back_inserter(to), front_row);
    const double* next = updates_[child].data();
    for (auto column = to.begin(); column != to.end(); ++column) {
      for (auto row = column; row != to.end(); ++row) {
        front(*row, *column) += *next++;
      }
    }
    if (!keeps_) {
      updates_[child] = {};
    }
  }
  return front;
}

namespace {

/// Subtracts below · belowᵀ from the lower triangle of a matrix, some columns at a time: on a slow machine, all of a
/// large front would take seconds, in which nobody could cancel. Reports `share` in between.
void subtract_square(Dense from, const Dense& below, const Progress& progress, double share) {
  for (Eigen::Index first = 0; first < from.cols(); first += columns_subtracted) {
    progress.report(share);
    const Eigen::Index columns = std::min(columns_subtracted, from.cols() - first);
    const Eigen::Index rest = from.rows() - first - columns;
    const auto own = below.middleRows(first, columns);
    chainmail::subtract_square(from.block(first, first, columns, columns), own);
    add_outer_product(from.block(first + columns, first, rest, columns), -1, below.bottomRows(rest), own);
  }
}

/// Eliminates the first `width` columns of a front. Only the lower triangle is used. Returns false if it is not
/// positive definite.
bool eliminate(Eigen::MatrixXd& front, Eigen::Index width, const Progress& progress) {
  for (Eigen::Index first = 0; first < width; first += columns_at_once) {
    progress.report(double(first) / double(width));
    const Eigen::Index columns = std::min(columns_at_once, width - first), rest = front.rows() - first - columns;
    const Dense own = front.block(first, first, columns, columns);
    const Dense below = front.block(first + columns, first, rest, columns);
    if (!factor_positive(own)) {
      return false;
    }
    if (rest > 0) {
      solve_on_the_right(own, below);
      subtract_square(front.bottomRightCorner(rest, rest), below, progress, double(first) / double(width));
    }
  }
  return true;
}

}  // namespace

bool Cholesky::factor(const Sparse& lower, const Progress& progress) {
  has_updates_ = keeps_;
  return factor_some(std::vector<bool>(supernodes_.size(), true), lower, progress);
}

bool Cholesky::refactor(const Sparse& lower, std::span<const int> columns, const Progress& progress) {
  if (!has_updates_ || !has_factors_) {
    return factor(lower, progress);
  }
  std::vector<bool> which(supernodes_.size(), false);
  for (const int column : columns) {
    const auto next = std::ranges::upper_bound(supernodes_, column, {}, &Supernode::first);
    which[static_cast<std::size_t>(next - supernodes_.begin()) - 1] = true;
  }
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    const auto& children = supernodes_[s].children;
    which[s] = which[s] || std::ranges::any_of(children, [&](std::size_t child) { return bool(which[child]); });
  }
  return factor_some(which, lower, progress);
}

/// Factors these supernodes. The updates of the other ones are those of the last factorization.
bool Cholesky::factor_some(const std::vector<bool>& which, const Sparse& lower, const Progress& progress) {
  has_factors_ = false;
  const double count = double(supernodes_.size());
  for (std::size_t s = 0; s < supernodes_.size(); ++s) {
    if (!which[s]) {
      continue;
    }
    const Supernode& one = supernodes_[s];
    Eigen::MatrixXd front = front_of(one, lower);
    if (!eliminate(front, one.width, progress.part(double(s) / count, double(s + 1) / count))) {
      return false;
    }
    Update& update = updates_[s];
    update.clear();
    update.reserve(static_cast<std::size_t>((front.rows() - one.width) * (front.rows() - one.width + 1) / 2));
    for (Eigen::Index j = one.width; j < front.cols(); ++j) {
      const double* column = front.col(j).data();
      update.insert(update.end(), column + j, column + front.rows());
    }
    Eigen::Map<Eigen::MatrixXd>(panels_.data() + one.panel, one.height(), one.width) = front.leftCols(one.width);
  }
  has_factors_ = true;
  return true;
}

Eigen::MatrixXd Cholesky::solve(Eigen::MatrixXd right) const {
  const auto below_of = [&](const Supernode& one) {
    return std::span(one.rows).subspan(static_cast<std::size_t>(one.width));
  };
  for (const Supernode& one : supernodes_) {
    const Panel panel = panel_of(one);
    const Dense own = right.middleRows(one.first, one.width);
    solve_lower(panel.topRows(one.width), own);
    Eigen::MatrixXd update = Eigen::MatrixXd::Zero(one.height() - one.width, right.cols());
    add_product(update, -1, panel.bottomRows(one.height() - one.width), own);
    Eigen::Index i = 0;
    for (const int row : below_of(one)) {
      right.row(row) += update.row(i++);
    }
  }
  for (std::size_t s = supernodes_.size(); s-- > 0;) {
    const Supernode& one = supernodes_[s];
    const Panel panel = panel_of(one);
    Eigen::MatrixXd below(one.height() - one.width, right.cols());
    Eigen::Index i = 0;
    for (const int row : below_of(one)) {
      below.row(i++) = right.row(row);
    }
    const Dense own = right.middleRows(one.first, one.width);
    add_transposed_product(own, -1, panel.bottomRows(one.height() - one.width), below);
    solve_lower_transposed(panel.topRows(one.width), own);
  }
  return right;
}

}  // namespace chainmail

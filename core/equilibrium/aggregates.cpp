#include "equilibrium/aggregates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "equilibrium/unique_ids.h"

namespace chainmail {
namespace {

/// Two rows whose coupling is below this share of their diagonal blocks do not join an aggregate.
constexpr float weak_coupling = 0.01F;

/// Forms aggregates of rows with strong couplings.
class AggregateSearch {
 public:
  AggregateSearch(std::vector<std::uint32_t>& of, std::vector<std::vector<std::uint32_t>>& members,
                  const Aggregates::Couplings& couplings)
      : of_(of), members_(members), couplings_(couplings), scale_(of.size()) {
    for (std::uint32_t row = 0; row < of_.size(); ++row) {
      for (const auto& [column, square] : couplings_(row)) {
        if (column == row) {
          scale_[row] = std::sqrt(square);
        }
      }
    }
  }

  void run() {
    for (std::uint32_t row = 0; row < of_.size(); ++row) {
      if (of_[row] == Aggregates::none) {
        begin_at(row);
      }
    }
    join_left_rows();
  }

 private:
  bool is_strong(std::uint32_t row, const Aggregates::Coupling& one) const {
    return one.column != row && one.square > weak_coupling * weak_coupling * scale_[row] * scale_[one.column];
  }

  /// Begins an aggregate of a row and its neighbours, if all are free.
  void begin_at(std::uint32_t row) {
    const auto couplings = couplings_(row);
    bool is_free = true, is_alone = true;
    for (const Aggregates::Coupling& one : couplings) {
      if (is_strong(row, one)) {
        is_free = is_free && of_[one.column] == Aggregates::none;
        is_alone = false;
      }
    }
    if (is_free && !is_alone) {
      const auto a = static_cast<std::uint32_t>(members_.size());
      of_[row] = a;
      members_.push_back({row});
      for (const Aggregates::Coupling& one : couplings) {
        if (is_strong(row, one)) {
          of_[one.column] = a;
          members_[a].push_back(one.column);
        }
      }
    }
  }

  /// Lets each row that is left join the aggregate of its strongest neighbour.
  void join_left_rows() {
    std::vector<std::uint32_t> joined(of_.size(), Aggregates::none);
    for (std::uint32_t row = 0; row < of_.size(); ++row) {
      float strongest = 0;
      if (of_[row] != Aggregates::none) {
        continue;
      }
      for (const Aggregates::Coupling& one : couplings_(row)) {
        if (is_strong(row, one) && of_[one.column] != Aggregates::none && one.square / scale_[one.column] > strongest) {
          strongest = one.square / scale_[one.column];
          joined[row] = of_[one.column];
        }
      }
    }
    for (std::uint32_t row = 0; row < of_.size(); ++row) {
      if (joined[row] != Aggregates::none) {
        of_[row] = joined[row];
        members_[joined[row]].push_back(row);
      }
    }
  }

  std::vector<std::uint32_t>& of_;
  std::vector<std::vector<std::uint32_t>>& members_;
  const Aggregates::Couplings& couplings_;
  std::vector<float> scale_;  // of each row: norm of its diagonal block
};

}  // namespace

void Aggregates::form(std::uint32_t rows, const Couplings& couplings) {
  of_.assign(rows, none);
  members_.clear();
  AggregateSearch(of_, members_, couplings).run();
}

auto Aggregates::members_of(const Ids& aggregates) const -> Ids {
  Ids rows;
  for (const std::uint32_t a : aggregates) {
    rows.insert(rows.end(), members_[a].begin(), members_[a].end());
  }
  return rows;
}

void Aggregates::append_like(std::uint32_t row) {
  of_.push_back(of_[row]);
  if (of_.back() != none) {
    members_[of_.back()].push_back(row_count() - 1);
  }
}

auto Aggregates::split(const Ids& rows, const Couplings& couplings, const std::function<bool(std::uint32_t)>& is_fixed,
                       Ids& like) -> Ids {
  Ids suspects, moved;
  for (const std::uint32_t row : rows) {
    if (of_[row] != none) {
      suspects.push_back(of_[row]);
    }
  }
  make_unique(suspects);
  for (const std::uint32_t a : suspects) {
    std::vector<Ids> parts = parts_of(a, couplings, is_fixed);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      for (const std::uint32_t row : parts[i]) {
        of_[row] = size();
      }
      moved.insert(moved.end(), parts[i].begin(), parts[i].end());
      members_.push_back(std::move(parts[i]));
      like.push_back(a);
    }
    members_[a] = std::move(parts[0]);
  }
  return moved;
}

/// Returns the members of an aggregate, in parts that couplings hold together. Fixed rows are in the first part.
auto Aggregates::parts_of(std::uint32_t aggregate, const Couplings& couplings,
                          const std::function<bool(std::uint32_t)>& is_fixed) const -> std::vector<Ids> {
  std::vector<Ids> parts(1);
  Ids left;
  for (const std::uint32_t row : members_[aggregate]) {
    (is_fixed(row) ? parts[0] : left).push_back(row);
  }
  while (!left.empty()) {
    Ids part{left.back()};
    left.pop_back();
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const Coupling& one : couplings(part[i])) {
        const auto found = one.square > 0 ? std::ranges::find(left, one.column) : left.end();
        if (found != left.end()) {
          part.push_back(one.column);
          left.erase(found);
        }
      }
    }
    parts.push_back(std::move(part));
  }
  if (parts[0].empty() && parts.size() > 1) {
    parts.erase(parts.begin());
  }
  return parts;
}

auto Aggregates::with_neighbours(const Ids& rows, const Couplings& couplings) -> Ids {
  Ids result;
  const auto add = [&](std::uint32_t row) {
    if (std::exchange(is_found_[row], 1) == 0) {
      result.push_back(row);
    }
  };
  is_found_.resize(row_count());
  for (const std::uint32_t row : rows) {
    add(row);
    for (const Coupling& one : couplings(row)) {
      add(one.column);
    }
  }
  for (const std::uint32_t row : result) {
    is_found_[row] = 0;
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace chainmail

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace chainmail {

/// Groups of neighbouring rows of a sparse matrix of blocks. Each is a row of the next coarser matrix. Only the
/// positions and the sizes of blocks matter.
class Aggregates {
 public:
  using Ids = std::vector<std::uint32_t>;

  /// A block of a row, which may be on the diagonal.
  struct Coupling {
    std::uint32_t column;
    float square;  // squared norm of the block
  };
  /// Returns the blocks of a row, until it is called again.
  using Couplings = std::function<std::span<const Coupling>(std::uint32_t row)>;

  /// The aggregate of a row without strong couplings.
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Forms the aggregates of this many rows.
  void form(std::uint32_t rows, const Couplings& couplings);
  std::uint32_t size() const { return static_cast<std::uint32_t>(members_.size()); }
  /// Number of rows.
  std::uint32_t row_count() const { return static_cast<std::uint32_t>(of_.size()); }
  std::uint32_t of(std::uint32_t row) const { return of_[row]; }
  const Ids& members(std::uint32_t aggregate) const { return members_[aggregate]; }
  /// Returns the members of these aggregates.
  Ids members_of(const Ids& aggregates) const;

  /// Adds a row to the aggregate of another row.
  void append_like(std::uint32_t row);
  /// Splits the aggregates of these rows where no couplings hold them together. Fixed rows stay. Returns the rows that
  /// got another aggregate, and adds to `like` the aggregate that each new one was split from.
  Ids split(const Ids& rows, const Couplings& couplings, const std::function<bool(std::uint32_t)>& is_fixed, Ids& like);
  /// Returns these rows and those that they are coupled with, ascending.
  Ids with_neighbours(const Ids& rows, const Couplings& couplings);

 private:
  std::vector<Ids> parts_of(std::uint32_t aggregate, const Couplings& couplings,
                            const std::function<bool(std::uint32_t)>& is_fixed) const;

  Ids of_;                              // of each row: its aggregate
  std::vector<Ids> members_;            // of each aggregate
  std::vector<std::uint8_t> is_found_;  // of each row, while rows are searched; else all 0
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include "equilibrium/shared_loop.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Moves a valid state toward any other state, as far as links allow.
///
/// On each axis, the valid states that lie between two states have a greatest one, since the larger of two valid states
/// is valid, element by element. So from the valid state v and the wanted state w: max(v, w) is lowered to the greatest
/// valid state below it, which is not below v; then the minimum of this and w is raised to the least valid state above
/// it. The result is the mean of this and of its mirror image, with min and max exchanged. If w is valid, the result is
/// w. Elements at which v and w are equal stay. The order of elements and links does not matter.
///
/// `State` has positions (displacements from rest, on all axes), regions, and neighbours, like BodyView.
template <class State>
class ValidProjection {
 public:
  static constexpr int Dimension = State::Dimension;

  /// Violations below `tolerance` (mesh units) are left as they are. Links between two fixed elements do not count.
  ValidProjection(const State& state, const std::vector<std::uint8_t>& fixed, double tolerance)
      : state_(state), fixed_(fixed), tolerance_(tolerance), queued_(state.positions.size()) {}

  /// Returns true if all links are valid in these displacements.
  template <class Positions>
  bool is_valid(const Positions& positions, const SharedLoop& shared = {}) const {
    return shared.all(state_.mesh->element_count(), [&](std::size_t element) {
      const auto e = static_cast<ElementId>(element);
      bool holds = true;
      state_.for_each_neighbour(e, [&](ElementId n, EntryId entry) {
        if (n < e || (fixed_[e] != 0 && fixed_[n] != 0)) {
          return;
        }
        const auto& region = state_.regions[entry];
        for (int k = 0; k < Dimension; ++k) {
          const double apart = positions[n][k] - positions[e][k];
          holds = holds && apart >= region.low[k] - tolerance_ && apart <= region.high[k] + tolerance_;
        }
      });
      return holds;
    });
  }

  /// Moves the positions `valid` on all axes toward `wanted`.
  template <class Valid, class Wanted>
  void run(Valid& valid, const Wanted& wanted) {
    std::vector<double> first(valid.size()), second(valid.size());
    for (int k = 0; k < Dimension; ++k) {
      const auto meet = [&](std::vector<double>& at, bool low) {
        for (std::size_t e = 0; e < at.size(); ++e) {
          at[e] = low ? std::min(at[e], wanted[e][k]) : std::max(at[e], wanted[e][k]);
        }
      };
      for (std::size_t e = 0; e < valid.size(); ++e) {
        first[e] = second[e] = valid[e][k];
      }
      meet(first, false);
      lower(first, k);
      meet(first, true);
      raise(first, k);
      meet(second, true);
      raise(second, k);
      meet(second, false);
      lower(second, k);
      for (std::size_t e = 0; e < valid.size(); ++e) {
        if (fixed_[e] == 0) {
          valid[e][k] = (first[e] + second[e]) / 2;
        }
      }
    }
  }

 private:
  template <class Visit>
  void for_each_free(ElementId e, Visit visit) const {
    state_.for_each_neighbour(e, [&](ElementId n, EntryId entry) {
      if (fixed_[e] == 0 || fixed_[n] == 0) {
        visit(n, state_.regions[entry]);
      }
    });
  }

  /// Finds the greatest valid state that is not above `at`, on one axis.
  void lower(std::vector<double>& at, int k) {
    spread(at, [&](ElementId e, ElementId n, const auto& region) {
      const double limit = at[e] + region.high[k];
      return at[n] > limit + tolerance_ ? (at[n] = limit, true) : false;
    });
  }

  /// Finds the least valid state that is not below `at`, on one axis.
  void raise(std::vector<double>& at, int k) {
    spread(at, [&](ElementId e, ElementId n, const auto& region) {
      const double limit = at[e] + region.low[k];
      return at[n] < limit - tolerance_ ? (at[n] = limit, true) : false;
    });
  }

  template <class Push>
  void spread(const std::vector<double>& at, Push push) {
    const auto visit = [&](ElementId e) {
      for_each_free(e, [&](ElementId n, const auto& region) {
        if (push(e, n, region) && queued_[n] == 0) {
          queued_[n] = 1;
          queue_.push_back(n);
        }
      });
    };
    for (ElementId e = 0; e < at.size(); ++e) {
      visit(e);
    }
    while (!queue_.empty()) {
      const ElementId e = queue_.front();
      queue_.pop_front();
      queued_[e] = 0;
      visit(e);
    }
  }

  const State& state_;
  const std::vector<std::uint8_t>& fixed_;
  double tolerance_;
  std::vector<std::uint8_t> queued_;
  std::deque<ElementId> queue_;
};

}  // namespace chainmail

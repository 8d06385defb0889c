#pragma once

#include <algorithm>
#include <limits>

#include "body/positions.h"
#include "body/region.h"

namespace chainmail {

/// Target of the handle, as bounds of displacements. On an axis along which it moves up, `low` is the target and `high`
/// is infinite. On an axis along which it moves down, `high` is the target and `low` is minus infinite. On an axis
/// along which it stays, both are infinite. A handle that has rotated moves its elements both ways: then both are the
/// target.
///
/// A handle of one element is at the displacement of that element. Of a handle of many, each element is at the
/// handle's displacement plus an offset of its own.
template <class Scalar, int Dimension>
struct HandleReach {
  static constexpr Scalar infinite = std::numeric_limits<Scalar>::infinity();

  HandleReach(const Position<Scalar, Dimension>& from, const Scalar* target) {
    for (int k = 0; k < Dimension; ++k) {
      start[k] = from[k];
      set(k, target[k]);
    }
  }
  /// The reach of a handle that has rotated and is at a displacement.
  explicit HandleReach(const Position<Scalar, Dimension>& at) {
    for (int k = 0; k < Dimension; ++k) {
      start[k] = to[k] = low[k] = high[k] = at[k];
    }
  }

  /// A reach for which every element moves, and that no pin stops.
  static HandleReach everywhere() {
    HandleReach reach{Position<Scalar, Dimension>{}};
    std::fill_n(reach.low, Dimension, std::numeric_limits<Scalar>::max());
    std::fill_n(reach.high, Dimension, std::numeric_limits<Scalar>::lowest());
    reach.is_everywhere = true;
    return reach;
  }

  void set(int k, Scalar target) {
    to[k] = target;
    low[k] = target > start[k] ? target : -infinite;
    high[k] = target < start[k] ? target : infinite;
  }

  /// Limits the reach of the handle by a pinned element, which has this region about the handle.
  void hold(const Position<Scalar, Dimension>& pin, const Region<Scalar, Dimension>& region) {
    for (int k = 0; k < Dimension && !is_everywhere; ++k) {
      const Scalar furthest = std::max(start[k], pin[k] - region.low[k]);
      const Scalar lowest = std::min(start[k], pin[k] - region.high[k]);
      if (low[k] > furthest || high[k] < lowest) {
        set(k, low[k] > furthest ? furthest : lowest);
        stopped[k] = true;
      }
    }
  }

  Scalar start[Dimension], to[Dimension];
  Scalar low[Dimension], high[Dimension];
  bool stopped[Dimension]{};
  bool is_everywhere = false;
};

}  // namespace chainmail

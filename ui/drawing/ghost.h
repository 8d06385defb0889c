#pragma once

#include <algorithm>
#include <optional>

namespace chainmail {

/// Another panel's object, laid over a panel's own.
struct Ghost {
  std::optional<int> of;  // the other panel
  double blend = 0.5;     // 0: only the own object, 1: only the other's

  double opacity() const { return blend; }
  double ownOpacity() const { return of ? std::min(1.0, 2 - 2 * blend) : 1; }
  bool operator==(const Ghost&) const = default;
};

}  // namespace chainmail

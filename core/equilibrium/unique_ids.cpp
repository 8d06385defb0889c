#include "equilibrium/unique_ids.h"

#include <algorithm>

namespace chainmail {

void make_unique(std::vector<std::uint32_t>& ids) {
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace chainmail

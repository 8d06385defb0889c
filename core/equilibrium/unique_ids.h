#pragma once

#include <cstdint>
#include <vector>

namespace chainmail {

/// Sorts ids, and leaves each of them once.
void make_unique(std::vector<std::uint32_t>& ids);

}  // namespace chainmail

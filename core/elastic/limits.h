#pragma once

#include <cstdint>

namespace chainmail {

/// Largest number of elements of a volume that linear FEM accepts. The other methods of elasticity accept fewer.
inline constexpr std::uint64_t max_fem_elements = 30'000;

}  // namespace chainmail

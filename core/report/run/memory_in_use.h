#pragma once

#include <cstdint>
#include <optional>

namespace chainmail::report {

/// Returns the number of bytes that the process has allocated and not freed; none where the system does not tell.
std::optional<std::uint64_t> bytes_in_use();
/// Returns how many bytes more are in use than `before`; none if that is not known.
std::optional<std::uint64_t> bytes_since(const std::optional<std::uint64_t>& before);
/// Returns the sum; none if one of them is not known.
std::optional<std::uint64_t> sum_of(const std::optional<std::uint64_t>& a, const std::optional<std::uint64_t>& b);

}  // namespace chainmail::report

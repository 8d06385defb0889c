#include "report/run/memory_in_use.h"

#include <algorithm>
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <malloc.h>
#define CHAINMAIL_COUNTS_BYTES
#endif

namespace chainmail::report {

/// glibc counts small blocks in its arenas and large ones apart. The allocators of the sanitizers do not count.
std::optional<std::uint64_t> bytes_in_use() {
#ifdef CHAINMAIL_COUNTS_BYTES
  const auto all = mallinfo2();
  return all.uordblks + all.hblkhd;
#else
  return std::nullopt;
#endif
}

std::optional<std::uint64_t> bytes_since(const std::optional<std::uint64_t>& before) {
  const auto now = bytes_in_use();
  return now && before ? std::optional(*now - std::min(*now, *before)) : std::nullopt;
}

std::optional<std::uint64_t> sum_of(const std::optional<std::uint64_t>& a, const std::optional<std::uint64_t>& b) {
  return a && b ? std::optional(*a + *b) : std::nullopt;
}

}  // namespace chainmail::report

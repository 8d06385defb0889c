#pragma once

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

// A pass visits a front that crosses the whole object, so that nearly each access is in another page of 4 KiB, and its
// address must be looked up. Pages of 2 MiB made first passes of a million elements 1.2 to 2 times as fast (measured by
// bench_passes). Linux gives them to programs that ask.

namespace chainmail {

inline constexpr std::size_t large_page = std::size_t{2} << 20;  // bytes

/// Allocates large blocks in large pages where the system has them, and small ones as usual.
template <class T>
struct LargePageAllocator {
  using value_type = T;  // NOLINT(readability-identifier-naming): a name of the standard library

  LargePageAllocator() = default;
  template <class Other>
  LargePageAllocator(const LargePageAllocator<Other>& /*other*/) {}  // NOLINT(google-explicit-constructor)

  static bool is_large(std::size_t count) { return count * sizeof(T) >= 2 * large_page; }

  T* allocate(std::size_t count) {
    if (!is_large(count)) {
      return std::allocator<T>().allocate(count);
    }
    void* memory = ::operator new (count * sizeof(T), std::align_val_t{large_page});
#ifdef __linux__
    // A refusal costs only speed. The last page is left out: it may be used only in part.
    ::madvise(memory, count * sizeof(T) / large_page * large_page, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (!is_large(count)) {
      std::allocator<T>().deallocate(memory, count);
    } else {
      ::operator delete (memory, std::align_val_t{large_page});
    }
  }

  bool operator==(const LargePageAllocator& /*other*/) const { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;

/// Memory for a number of values, which are not initialised: unused pages take no memory.
template <class T>
class LargeArray {
 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t count) : values_(LargePageAllocator<T>().allocate(count), Release{count}) {}

  explicit operator bool() const { return values_ != nullptr; }
  T* get() const { return values_.get(); }
  T& operator[](std::size_t i) const { return values_.get()[i]; }

 private:
  static_assert(std::is_trivially_copyable_v<T>);
  struct Release {
    std::size_t count = 0;
    void operator()(T* values) const { LargePageAllocator<T>().deallocate(values, count); }
  };
  std::unique_ptr<T, Release> values_;
};

/// Gives advice on the large pages that lie inside memory.
inline void advise_large_pages([[maybe_unused]] const void* memory, [[maybe_unused]] std::size_t bytes,
                               [[maybe_unused]] int advice) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + large_page - 1) / large_page * large_page;
  const std::uintptr_t end = (begin + bytes) / large_page * large_page;
  if (first < end) {
    ::madvise(reinterpret_cast<void*>(first), end - first, advice);  // NOLINT(performance-no-int-to-ptr)
  }
#endif
}

/// Moves values that are in memory already into large pages, if the system can.
template <class T>
void move_to_large_pages(std::span<const T> values) {
  constexpr int collapse = 25;  // MADV_COLLAPSE of Linux 6.1, which older headers do not name and older systems refuse
  advise_large_pages(values.data(), values.size_bytes(), collapse);
}

/// Makes room in an empty vector. Its memory becomes large pages when it is first used, which is faster than moving it.
template <class T>
void reserve_in_large_pages(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
#ifdef __linux__
  advise_large_pages(values.data(), count * sizeof(T), MADV_HUGEPAGE);
#endif
}

}  // namespace chainmail

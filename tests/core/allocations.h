#pragma once

#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>

/// Counts the memory that a program allocates by operator new, and lets large allocations fail. It replaces all forms
/// of operator new, under sanitizers too, so only one source of a program may include it. Memory that a library
/// allocates by malloc is not counted.
namespace chainmail::test {

inline std::atomic<std::uint64_t> allocations = 0;
inline std::atomic<std::size_t> bytes_held = 0;
inline std::atomic<std::size_t> max_bytes_held = 0;  // since it was last set to bytes_held; exact only for one thread

/// Allocations of more bytes fail, in all threads.
inline std::atomic<std::size_t> largest_allocation = std::numeric_limits<std::size_t>::max();

/// Lets allocations of more than some bytes fail while it exists.
struct LittleMemory {
  explicit LittleMemory(std::size_t largest) { largest_allocation = largest; }
  LittleMemory(const LittleMemory&) = delete;
  LittleMemory& operator=(const LittleMemory&) = delete;
  ~LittleMemory() { largest_allocation = std::numeric_limits<std::size_t>::max(); }
};

inline void* counted(std::size_t bytes, std::size_t alignment) noexcept {
  if (bytes > largest_allocation.load(std::memory_order_relaxed)) {
    return nullptr;
  }
  allocations.fetch_add(1, std::memory_order_relaxed);
  // aligned_alloc accepts only multiples of the alignment.
  void* taken = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  const std::size_t size = malloc_usable_size(taken);
  const std::size_t held = bytes_held.fetch_add(size, std::memory_order_relaxed) + size;
  if (held > max_bytes_held.load(std::memory_order_relaxed)) {
    max_bytes_held.store(held, std::memory_order_relaxed);
  }
  return taken;
}

inline void give_back(void* taken) noexcept {
  bytes_held.fetch_sub(malloc_usable_size(taken), std::memory_order_relaxed);
  std::free(taken);
}

inline void* counted_or_throw(std::size_t bytes, std::size_t alignment = alignof(std::max_align_t)) {
  void* taken = counted(bytes, alignment);
  return taken != nullptr ? taken : throw std::bad_alloc();
}

}  // namespace chainmail::test

void* operator new(std::size_t bytes) { return chainmail::test::counted_or_throw(bytes); }
void* operator new[](std::size_t bytes) { return chainmail::test::counted_or_throw(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return chainmail::test::counted(bytes, alignof(std::max_align_t));
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return chainmail::test::counted(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return chainmail::test::counted_or_throw(bytes, std::size_t(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return chainmail::test::counted_or_throw(bytes, std::size_t(alignment));
}
void operator delete(void* taken) noexcept { chainmail::test::give_back(taken); }
void operator delete[](void* taken) noexcept { chainmail::test::give_back(taken); }
void operator delete(void* taken, std::size_t /*bytes*/) noexcept { chainmail::test::give_back(taken); }
void operator delete[](void* taken, std::size_t /*bytes*/) noexcept { chainmail::test::give_back(taken); }
void operator delete(void* taken, std::align_val_t /*alignment*/) noexcept { chainmail::test::give_back(taken); }
void operator delete[](void* taken, std::align_val_t /*alignment*/) noexcept { chainmail::test::give_back(taken); }
void operator delete(void* taken, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  chainmail::test::give_back(taken);
}
void operator delete[](void* taken, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  chainmail::test::give_back(taken);
}

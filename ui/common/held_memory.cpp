#include "common/held_memory.h"

#include <sys/mman.h>

namespace chainmail {

bool HeldMemory::hold(std::size_t bytes) noexcept {
  if (bytes == bytes_) {
    return true;
  }
  release();
  void* begin = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (begin == MAP_FAILED) {
    return false;
  }
  begin_ = begin;
  bytes_ = bytes;
  return true;
}

void HeldMemory::release() noexcept {
  if (begin_ != nullptr) {
    ::munmap(begin_, bytes_);
    begin_ = nullptr;
    bytes_ = 0;
  }
}

}  // namespace chainmail

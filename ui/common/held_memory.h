#pragma once

#include <cstddef>

namespace chainmail {

/// Address space that is held for later. It is never touched, so it takes no memory of the machine, but it counts in
/// limits such as `ulimit -v`: what was held can be taken when nothing else is left.
class HeldMemory {
 public:
  HeldMemory() = default;
  HeldMemory(const HeldMemory&) = delete;
  HeldMemory& operator=(const HeldMemory&) = delete;
  ~HeldMemory() { release(); }

  /// Holds this many bytes, instead of those held before. Returns false, and holds nothing, if there are not so many.
  bool hold(std::size_t bytes) noexcept;
  void release() noexcept;
  std::size_t bytes() const { return bytes_; }

 private:
  void* begin_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace chainmail

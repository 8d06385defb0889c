#pragma once

#include <cstddef>
#include <vector>

namespace chainmail {

/// First in, first out, in a ring that only grows: after warm-up a pass allocates no memory.
template <class T>
class Ring {
 public:
  bool empty() const { return first_ == last_; }
  std::size_t size() const { return last_ - first_; }
  void admit(const T& one) {
    if (last_ - first_ == ring_.size()) {
      grow();
    }
    ring_[last_++ & (ring_.size() - 1)] = one;
  }
  void clear() { first_ = last_; }
  T take() { return ring_[first_++ & (ring_.size() - 1)]; }

 private:
  void grow() {
    std::vector<T> larger(2 * ring_.size());
    for (std::size_t i = first_; i != last_; ++i) {
      larger[i & (larger.size() - 1)] = ring_[i & (ring_.size() - 1)];
    }
    ring_.swap(larger);
  }

  std::vector<T> ring_ = std::vector<T>(64);  // a power of two
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

}  // namespace chainmail

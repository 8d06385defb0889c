#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail::bench {

/// The schedules that Exact ChainMail was tried with, beside the one that it has (core/solve/
/// exact_schedule.h says what a schedule is).

template <class Scalar>
struct Waiting {
  Scalar key;
  ElementId element;
};

/// Label correcting, first in, first out (Bellman, Ford, Moore).
template <class Scalar>
class FifoSchedule {
 public:
  static constexpr bool keeps_place = true;
  bool empty() const { return first_ == last_; }
  void begin(Scalar) {}
  void admit(ElementId element, Scalar key) {
    if (last_ - first_ == ring_.size()) {
      std::vector<Waiting<Scalar>> larger(2 * ring_.size());
      for (std::size_t i = first_; i != last_; ++i) {
        larger[i & (larger.size() - 1)] = ring_[i & (ring_.size() - 1)];
      }
      ring_.swap(larger);
    }
    ring_[last_++ & (ring_.size() - 1)] = {key, element};
  }
  Waiting<Scalar> take() { return ring_[first_++ & (ring_.size() - 1)]; }

 private:
  std::vector<Waiting<Scalar>> ring_ = std::vector<Waiting<Scalar>>(64);
  std::size_t first_ = 0, last_ = 0;
};

/// Label setting by a binary heap (Dijkstra).
template <class Scalar>
class HeapSchedule {
 public:
  static constexpr bool keeps_place = false;
  bool empty() const { return heap_.empty(); }
  void begin(Scalar) {}
  void admit(ElementId element, Scalar key) {
    heap_.push_back({key, element});
    std::push_heap(heap_.begin(), heap_.end(), smaller);
  }
  Waiting<Scalar> take() {
    std::pop_heap(heap_.begin(), heap_.end(), smaller);
    const auto entry = heap_.back();
    heap_.pop_back();
    return entry;
  }

 private:
  static bool smaller(const Waiting<Scalar>& a, const Waiting<Scalar>& b) { return a.key < b.key; }
  std::vector<Waiting<Scalar>> heap_;
};

/// Buckets of equal width over the keys, each a stack: between label setting and label correcting (Dial;
/// delta-stepping, Meyer and Sanders 2003, in one thread).
template <class Scalar, int Count>
class BucketSchedule {
 public:
  static constexpr bool keeps_place = false;
  bool empty() const { return size_ == 0; }
  void begin(Scalar largest) {
    largest_ = largest;
    scale_ = largest > 0 ? static_cast<Scalar>(Count - 1) / largest : 0;
    current_ = 0;
  }
  void admit(ElementId element, Scalar key) {
    const auto bucket = std::clamp(static_cast<int>((largest_ - key) * scale_), 0, Count - 1);
    current_ = std::min(current_, bucket);
    buckets_[bucket].push_back({key, element});
    ++size_;
  }
  Waiting<Scalar> take() {
    while (buckets_[current_].empty()) {
      ++current_;
    }
    const auto entry = buckets_[current_].back();
    buckets_[current_].pop_back();
    --size_;
    return entry;
  }

 private:
  std::vector<Waiting<Scalar>> buckets_[Count];
  Scalar largest_ = 0, scale_ = 0;
  int current_ = 0;
  std::size_t size_ = 0;
};

}  // namespace chainmail::bench

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "solve/ring.h"

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
  static constexpr bool adapts = false;
  bool keeps_place() const { return true; }
  bool empty() const { return queue_.empty(); }
  void begin(Scalar) {}
  void admit(ElementId element, Scalar) { queue_.admit(element); }
  Waiting<Scalar> take() { return {0, queue_.take()}; }

 private:
  Ring<ElementId> queue_;
};

/// Label setting by a binary heap (Dijkstra).
template <class Scalar>
class HeapSchedule {
 public:
  static constexpr bool adapts = false;
  bool keeps_place() const { return false; }
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
  static constexpr bool adapts = false;
  bool keeps_place() const { return false; }
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

/// Delta-stepping over a radix heap: keys in steps of a width, within a step first in, first out.
template <class Scalar>
class StepSchedule {
 public:
  static constexpr bool adapts = false;
  bool keeps_place() const { return false; }
  static inline double width = 1;
  bool empty() const { return size_ == 0; }
  void begin(Scalar largest) {
    largest_ = largest;
    scale_ = static_cast<Scalar>(1 / width);
    last_ = 0;
  }
  void admit(ElementId element, Scalar key) {
    const Scalar steps = (largest_ - key) * scale_;
    const auto step = std::max(last_, steps < 4e9 ? static_cast<std::uint32_t>(steps) : 4000000000u);
    put({key, element, step});
    ++size_;
  }
  Waiting<Scalar> take() {
    if (first_ == buckets_[0].size()) {
      buckets_[0].clear();
      first_ = 0;
      int from = 1;
      while (buckets_[from].empty()) {
        ++from;
      }
      last_ = buckets_[from][0].step;
      for (const auto& e : buckets_[from]) {
        last_ = std::min(last_, e.step);
      }
      for (const auto& e : buckets_[from]) {
        put(e);
      }
      buckets_[from].clear();
    }
    const auto& e = buckets_[0][first_++];
    --size_;
    return {e.key, e.element};
  }

 private:
  struct Entry {
    Scalar key;
    ElementId element;
    std::uint32_t step;
  };
  void put(const Entry& e) { buckets_[std::bit_width(e.step ^ last_)].push_back(e); }
  std::vector<Entry> buckets_[33];
  Scalar largest_ = 0, scale_ = 0;
  std::uint32_t last_ = 0;
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace chainmail::bench

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "solve/ring.h"

namespace chainmail {

/// Schedules define the order in which Exact ChainMail visits the elements whose regions about the handle became
/// narrower. They do not change a bit of the result; they differ in how often an element is visited again.
///
/// A key is the shortest path found since the element's last visit, at least 0. An element whose key shrinks while it
/// waits is admitted again, and the caller drops outdated entries; unless `keeps_position()`, when it is not admitted
/// again. A schedule that `adapts` receives statistics after each visit. `begin_drag()` is called for a new handle,
/// `begin()` for each pass. Elements are numbered in the order in which they became known.

/// Smallest key first, in a radix heap. Since keys hardly ever fall below the last one taken, an element is visited at
/// most once per side of each axis (label setting; Ahuja, Mehlhorn, Orlin and Tarjan 1990).
///
/// Keys are compared as the bits of non-negative numbers, which have the same order as the numbers.
template <class Scalar>
class RadixHeapSchedule {
 public:
  static constexpr bool adapts = false;
  struct Entry {
    Scalar key;
    std::uint32_t index;
  };

  bool keeps_position() const { return false; }
  bool empty() const { return size_ == 0; }

  void begin_drag() {}
  void begin() { last_ = 0; }

  void admit(std::uint32_t index, Scalar key) {
    buckets_[bucket_of(bits_of(key))].push_back({key, index});
    ++size_;
  }

  Entry take() {
    if (buckets_[0].empty()) {
      redistribute();
    }
    const Entry entry = buckets_[0].back();
    buckets_[0].pop_back();
    --size_;
    return entry;
  }

 private:
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  static constexpr int bucket_count = 8 * sizeof(Scalar) + 1;

  static Bits bits_of(Scalar key) { return std::bit_cast<Bits>(key + Scalar{0}); }  // -0 is 0
  int bucket_of(Bits bits) const { return std::bit_width(static_cast<Bits>(bits ^ last_)); }

  /// Distributes the first non-empty bucket over the buckets before it.
  void redistribute() {
    int first = 1;
    while (buckets_[first].empty()) {
      ++first;
    }
    auto& from = buckets_[first];
    last_ = bits_of(from.front().key);
    for (const Entry& entry : from) {
      last_ = std::min(last_, bits_of(entry.key));
    }
    for (const Entry& entry : from) {
      buckets_[bucket_of(bits_of(entry.key))].push_back(entry);
    }
    from.clear();
  }

  std::array<std::vector<Entry>, bucket_count> buckets_;
  Bits last_ = 0;  // bits of the smallest possible key
  std::size_t size_ = 0;
};

/// First in, first out, as long as hardly any element is visited again; then smallest key first.
///
/// With uniform softness the front moves outward once, and a queue that follows the links in space is fastest. With
/// mixed softness it would visit an element tens of times. So once visits exceed the known elements by a quarter,
/// waiting elements move to the heap, and for the rest of the drag an element is visited at most once per side of each
/// axis.
template <class Scalar>
class AdaptiveSchedule {
 public:
  static constexpr bool adapts = true;
  using Entry = typename RadixHeapSchedule<Scalar>::Entry;

  bool keeps_position() const { return !sets_labels_; }
  bool empty() const { return queue_.empty() && heap_.empty(); }

  void begin_drag() { sets_labels_ = false; }
  void begin() { heap_.begin(); }

  void admit(std::uint32_t index, Scalar key) {
    if (sets_labels_) {
      heap_.admit(index, key);
    } else {
      queue_.admit(index);
    }
  }

  Entry take() { return sets_labels_ ? heap_.take() : Entry{0, queue_.take()}; }

  /// Receives, after a visit, the number of visits in the drag and of known elements.
  template <class KeyOf>
  void visited(std::uint64_t visits, std::size_t known, KeyOf key_of) {
    if (sets_labels_ || visits <= known + known / 4 + 64) {
      return;
    }
    sets_labels_ = true;
    heap_.begin();
    while (!queue_.empty()) {
      const std::uint32_t index = queue_.take();
      heap_.admit(index, key_of(index));
    }
  }

 private:
  Ring<std::uint32_t> queue_;
  RadixHeapSchedule<Scalar> heap_;
  bool sets_labels_ = false;
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "solve/ring.h"

namespace chainmail {

/// Schedules say in what order Exact ChainMail visits the elements whose displacement grew. None changes
/// the result by a bit; they differ in how often an element is visited again. tests/bench has the table.
///
/// A key is the largest displacement that grew since the element's last visit, above 0. An element whose
/// key grows while it waits is admitted again, and the caller drops what it takes of it later; while the
/// schedule says that it `keeps_place()`, it is not. One that `adapts` is told after each visit how it goes.

/// Largest key first, in a radix heap: with keys that never exceed the last one taken, an element is
/// visited at most once a space dimension (label setting; Ahuja, Mehlhorn, Orlin and Tarjan 1990).
///
/// Keys are compared as the bits of a positive number, which are in the numbers' order.
template <class Scalar>
class RadixHeapSchedule {
 public:
  static constexpr bool adapts = false;
  struct Entry {
    Scalar key;
    ElementId element;
  };

  bool keeps_place() const { return false; }
  bool empty() const { return size_ == 0; }

  /// Begins a pass in which no key will exceed this one.
  void begin(Scalar largest) { last_ = bits_of(largest); }

  void admit(ElementId element, Scalar key) {
    buckets_[bucket_of(bits_of(key))].push_back({key, element});
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

  static Bits bits_of(Scalar key) { return std::bit_cast<Bits>(key); }
  int bucket_of(Bits bits) const { return std::bit_width(static_cast<Bits>(bits ^ last_)); }

  /// Spreads the first bucket that holds any over those before it.
  void redistribute() {
    int first = 1;
    while (buckets_[first].empty()) {
      ++first;
    }
    auto& from = buckets_[first];
    last_ = 0;
    for (const Entry& entry : from) {
      last_ = std::max(last_, bits_of(entry.key));
    }
    for (const Entry& entry : from) {
      buckets_[bucket_of(bits_of(entry.key))].push_back(entry);
    }
    from.clear();
  }

  std::array<std::vector<Entry>, bucket_count> buckets_;
  Bits last_ = 0;  // the bits of the largest key there may be
  std::size_t size_ = 0;
};

/// First in, first out, as long as hardly any element is visited again; then largest key first.
///
/// On even softness the front runs outward once, and a queue that follows the links in space is the
/// fastest. On mixed softness it would visit an element tens of times: once visits exceed the elements
/// reached by a quarter, what waits goes to the heap, and from there on an element is visited at most once
/// a space dimension.
template <class Scalar>
class AdaptiveSchedule {
 public:
  static constexpr bool adapts = true;
  using Entry = typename RadixHeapSchedule<Scalar>::Entry;

  bool keeps_place() const { return !sets_labels_; }
  bool empty() const { return queue_.empty() && heap_.empty(); }

  void begin(Scalar largest) {
    largest_ = largest;
    sets_labels_ = false;
  }

  void admit(ElementId element, Scalar key) {
    if (sets_labels_) {
      heap_.admit(element, key);
    } else {
      queue_.admit(element);
    }
  }

  Entry take() { return sets_labels_ ? heap_.take() : Entry{0, queue_.take()}; }

  /// Told after a visit how many there were, and how many elements were reached.
  template <class KeyOf>
  void visited(std::uint64_t visits, std::size_t reached, KeyOf key_of) {
    if (sets_labels_ || visits <= reached + reached / 4 + 64) {
      return;
    }
    sets_labels_ = true;
    heap_.begin(largest_);
    while (!queue_.empty()) {
      const ElementId element = queue_.take();
      heap_.admit(element, key_of(element));
    }
  }

 private:
  Ring<ElementId> queue_;
  RadixHeapSchedule<Scalar> heap_;
  Scalar largest_ = 0;
  bool sets_labels_ = false;
};

}  // namespace chainmail

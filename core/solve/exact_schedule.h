#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Schedules say in what order Exact ChainMail visits the elements whose displacement grew. None changes
/// the result by a bit; they differ in how often an element is visited again. tests/bench has the table.
///
/// A key is the largest displacement that grew since the element's last visit, above 0. An element whose
/// key grows while it waits is admitted again, and the caller drops what it takes of it later; where the
/// schedule says that it `keeps_place`, it is not.

/// Largest key first, in a radix heap: with keys that never exceed the last one taken, an element is
/// visited at most once a space dimension (label setting; Ahuja, Mehlhorn, Orlin and Tarjan 1990).
///
/// Keys are compared as the bits of a positive number, which are in the numbers' order.
template <class Scalar>
class RadixHeapSchedule {
 public:
  struct Entry {
    Scalar key;
    ElementId element;
  };
  static constexpr bool keeps_place = false;

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

  std::vector<Entry> buckets_[bucket_count];
  Bits last_ = 0;  // the bits of the largest key there may be
  std::size_t size_ = 0;
};

}  // namespace chainmail

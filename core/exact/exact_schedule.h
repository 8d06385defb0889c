#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "chainmail/waiting_list.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Schedules define the order in which Exact ChainMail visits the elements whose regions about the handle became
/// narrower. They do not change a bit of the result; they differ in how often an element is visited again.
///
/// A key is the shortest path found since the element's last visit, at least 0. An element whose key shrinks to that of
/// another bucket while it waits is admitted again, and the caller drops the entries of elements that do not wait;
/// unless `keeps_position()`, when it is not admitted again. A schedule that `adapts` says when it must. `begin_drag()`
/// is called for a new handle, `begin()` for each pass. Elements are numbered in the order in which they became known.
///
/// A schedule that `has_rounds` can serve one of several threads. `begin_round()` chooses the entries that `in_round()`
/// then admits: those that wait now, or those up to a bucket, the lowest of all threads.

/// Smallest key first, up to a bucket width; first in, first out in a bucket (delta-stepping, Meyer and Sanders 2003).
/// Buckets are numbered, and their numbers are in a radix heap (Ahuja, Mehlhorn, Orlin and Tarjan 1990): an entry is
/// moved a few times, and any number of buckets will do. With narrow buckets, hardly any element is visited more often
/// than once per side of each axis.
template <class Scalar>
class BucketSchedule {
 public:
  static constexpr bool adapts = false;
  static constexpr bool has_rounds = false;
  using Number = std::uint32_t;

  bool keeps_position() const { return false; }
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  /// Sets the width of the buckets (mesh units, above 0). The schedule must be empty.
  void set_width(Scalar width) { per_width_ = std::min(1 / width, std::numeric_limits<Scalar>::max()); }

  /// Drops all entries: a search that was cancelled may have left some.
  void begin_drag() {
    std::ranges::for_each(buckets_, [](auto& bucket) { bucket.clear(); });
    first_ = size_ = 0;
    last_ = 0;
  }
  void begin() { last_ = 0; }

  /// The bucket of a key.
  Number number(Scalar key) const {
    constexpr Scalar most = Scalar(std::numeric_limits<std::int32_t>::max()) / 2;
    return static_cast<Number>(std::clamp(key * per_width_, Scalar{0}, most));
  }

  void admit(std::uint32_t index, Scalar key) {
    const Number to = number(key);
    buckets_[place_of(to)].push_back({to, index});
    ++size_;
  }

  /// The lowest bucket, or the greatest number if the schedule is empty.
  Number lowest() const {
    if (first_ < buckets_[0].size()) {
      return last_;
    }
    const auto place =
        std::find_if(buckets_.begin() + 1, buckets_.end(), [](const auto& bucket) { return !bucket.empty(); });
    return place == buckets_.end() ? none : std::ranges::min_element(*place, {}, &Entry::number)->number;
  }
  void begin_round(Number lowest) { bound_ = lowest; }
  bool in_round() const { return size_ > 0 && lowest() <= bound_; }

  std::uint32_t take() {
    if (first_ == buckets_[0].size()) {
      redistribute();
    }
    --size_;
    return buckets_[0][first_++].index;
  }

 private:
  struct Entry {
    Number number;
    std::uint32_t index;
  };
  static constexpr int place_count = 8 * sizeof(Number) + 1;
  static constexpr Number none = std::numeric_limits<Number>::max();

  int place_of(Number number) const { return number <= last_ ? 0 : std::bit_width(number ^ last_); }

  /// Distributes the first entries that are not in the lowest bucket over the places before theirs.
  void redistribute() {
    buckets_[0].clear();
    first_ = 0;
    int from = 1;
    while (buckets_[from].empty()) {
      ++from;
    }
    last_ = std::ranges::min_element(buckets_[from], {}, &Entry::number)->number;
    for (const Entry& entry : buckets_[from]) {
      buckets_[place_of(entry.number)].push_back(entry);
    }
    buckets_[from].clear();
  }

  std::array<std::vector<Entry>, place_count> buckets_;
  Scalar per_width_ = 1;
  Number last_ = 0;        // the bucket from which entries are taken
  Number bound_ = none;    // of this round
  std::size_t first_ = 0;  // in buckets_[0]
  std::size_t size_ = 0;
};

/// First in, first out, as long as hardly any element is visited again; then smallest key first.
///
/// With uniform softness the front moves outward once, and a queue that follows the links in space is fastest. With
/// mixed softness it would visit an element tens of times. So once visits exceed the known elements by a quarter,
/// waiting elements move to buckets for the rest of the drag.
template <class Scalar>
class AdaptiveSchedule {
 public:
  static constexpr bool adapts = true;
  static constexpr bool has_rounds = true;
  /// Elements of an object that threads share: in smaller ones a round is too short. Measured in tests/bench.
  static constexpr std::size_t min_to_share = 100'000;
  using Number = typename BucketSchedule<Scalar>::Number;

  bool keeps_position() const { return !sets_labels_; }
  bool empty() const { return queue_.empty() && buckets_.empty(); }
  std::size_t size() const { return queue_.size() + buckets_.size(); }
  Number lowest() const { return sets_labels_ ? buckets_.lowest() : 0; }

  void begin_round(Number lowest) {
    in_round_ = queue_.size();
    buckets_.begin_round(lowest);
  }
  bool in_round() const { return sets_labels_ ? buckets_.in_round() : in_round_ > 0; }

  void begin_drag() {
    sets_labels_ = false;
    queue_.clear();
    buckets_.begin_drag();
  }
  void begin() { buckets_.begin(); }

  void admit(std::uint32_t index, Scalar key) {
    if (sets_labels_) {
      buckets_.admit(index, key);
    } else {
      queue_.admit(index);
    }
  }
  auto number(Scalar key) const { return buckets_.number(key); }

  std::uint32_t take() {
    if (sets_labels_) {
      return buckets_.take();
    }
    in_round_ -= in_round_ > 0 ? 1 : 0;
    return queue_.take();
  }

  /// True once elements are visited too often, after this number of visits in the drag.
  bool must_adapt(std::uint64_t visits, std::size_t known) const {
    return !sets_labels_ && visits > known + known / 4 + 64;
  }
  /// Goes on in the order of keys, in buckets of this width.
  template <class KeyOf>
  void adapt(Scalar width, KeyOf key_of) {
    sets_labels_ = true;
    buckets_.set_width(width);
    buckets_.begin();
    while (!queue_.empty()) {
      const std::uint32_t index = queue_.take();
      buckets_.admit(index, key_of(index));
    }
  }

 private:
  Ring<std::uint32_t> queue_;
  BucketSchedule<Scalar> buckets_;
  bool sets_labels_ = false;
  std::size_t in_round_ = 0;  // number of waiting elements that belong to this round
};

}  // namespace chainmail

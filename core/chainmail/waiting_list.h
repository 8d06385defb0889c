#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "mesh/mesh.h"

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

/// An element that may have to move, and its sponsor: the element whose move made it a candidate.
struct Candidate {
  EntryId entry;      // in the sponsor's row of the neighbour table: identifies the element and the region
  ElementId sponsor;  // 8 bytes in all
};

/// The order in which candidates are taken from a list: by their entry, or the largest key first.
enum class TakingOrder { first_in, last_in, by_key };

/// The candidates of a pass that wait: what the loop of a pass (propagate.h) asks of a list. The list defines the
/// algorithm. To add one that differs from others in its list only, add a list here, a constant to body/method.h
/// and an entry to solver/algorithms.cpp.
template <class List>
concept WaitingList = requires(List list, const List constant, const Mesh& mesh, Candidate candidate,
                               double violation) {
  { List::order } -> std::convertible_to<TakingOrder>;
  // True if elements that have been updated may enter; they are dropped when they are taken.
  { List::admits_updated } -> std::convertible_to<bool>;
  // True if the order depends on `violation`: how far the candidate lies outside its valid region (rest lengths).
  // Others get 0, and their passes can be replayed, because their order depends only on which elements moved.
  { List::by_violation } -> std::convertible_to<bool>;
  list.begin(mesh);
  { constant.admits(candidate) } -> std::same_as<bool>;
  { constant.key(candidate, violation) } -> std::same_as<double>;  // for TakingOrder::by_key
  list.admit(candidate, violation);
  { list.empty() } -> std::same_as<bool>;
  { list.take() } -> std::same_as<Candidate>;
};

/// What most lists have in common: every candidate is admitted, and violation does not matter.
struct PlainList {
  static constexpr bool by_violation = false;
  void begin(const Mesh& /*mesh*/) {}
  bool admits(Candidate /*candidate*/) const { return true; }
  double key(Candidate /*candidate*/, double /*violation*/) const { return 0; }
};

/// Generalized ChainMail (thesis 3.1, Li and Brodlie 2003): candidates enter at the front, so the last one in is taken
/// first; all are admitted.
class FrontList : public PlainList {
 public:
  static constexpr bool admits_updated = true;
  static constexpr TakingOrder order = TakingOrder::last_in;

  bool empty() const { return candidates_.empty(); }
  void admit(Candidate candidate, double /*violation*/) { candidates_.push_back(candidate); }
  Candidate take() {
    const Candidate candidate = candidates_.back();
    candidates_.pop_back();
    return candidate;
  }

 private:
  std::vector<Candidate> candidates_;
};

/// First in, first out.
using BackList = Ring<Candidate>;

/// Spiral (thesis 3.2, first alteration): candidates enter at the back; all are admitted.
class SpiralList : public PlainList {
 public:
  static constexpr bool admits_updated = true;
  static constexpr TakingOrder order = TakingOrder::first_in;

  bool empty() const { return candidates_.empty(); }
  void admit(Candidate candidate, double /*violation*/) { candidates_.admit(candidate); }
  Candidate take() { return candidates_.take(); }

 private:
  BackList candidates_;
};

/// Enhanced ChainMail (Schill et al. 1998): the largest violation is taken first, ties by entry; only those not yet
/// updated are admitted. Until a candidate is taken, its element does not move, and its sponsor has been updated: so
/// the violation at entry equals the violation when taken.
class EnhancedList : public PlainList {
 public:
  static constexpr bool admits_updated = false;
  static constexpr TakingOrder order = TakingOrder::by_key;
  static constexpr bool by_violation = true;

  double key(Candidate /*candidate*/, double violation) const { return violation; }
  bool empty() const { return heap_.empty(); }
  void admit(Candidate candidate, double violation) {
    heap_.push_back({violation, entered_++, candidate});
    std::push_heap(heap_.begin(), heap_.end(), later);
  }
  Candidate take() {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Candidate candidate = heap_.back().candidate;
    heap_.pop_back();
    return candidate;
  }

 private:
  struct Waiting {
    double violation;  // rest lengths
    std::uint64_t entry;
    Candidate candidate;
  };
  static bool later(const Waiting& one, const Waiting& other) {
    return one.violation != other.violation ? one.violation < other.violation : one.entry > other.entry;
  }

  std::vector<Waiting> heap_;
  std::uint64_t entered_ = 0;
};

/// The waiting list of 3D ChainMail (Frisken-Gibson 1997; thesis 2.1), for rectangular meshes: one list per direction.
///
/// Candidates are taken from the first list that is not empty, in the order right, left, top, bottom, front, back (+x,
/// −x, +y, −y, +z, −z). An element that was taken from a list feeds that list and those of later axes; the grabbed
/// element feeds all. Within a list: first in, first out. All candidates are admitted.
class DirectionLists : public PlainList {
 public:
  static constexpr bool admits_updated = true;
  static constexpr TakingOrder order = TakingOrder::by_key;

  /// Begins a pass: the grabbed element is the first sponsor.
  void begin(const Mesh& mesh) {
    mesh_ = &mesh;
    const auto& size = mesh.lattice->size;
    steps_ = {size[0] > 1 ? 1 : 0, size[1] > 1 ? size[0] : 0, size[2] > 1 ? std::int64_t{size[0]} * size[1] : 0};
    from_ = all_lists;
    first_ = 0;
  }

  bool admits(Candidate candidate) const {
    const int list = list_of(candidate);
    return from_ == all_lists || list == from_ || list / 2 > from_ / 2;
  }
  /// Candidates with the largest key are taken first.
  double key(Candidate candidate, double /*violation*/) const { return -list_of(candidate); }

  void admit(Candidate candidate, double /*violation*/) { lists_[std::size_t(list_of(candidate))].admit(candidate); }
  /// No list before the one in use is fed, so those stay empty.
  bool empty() {
    while (first_ < list_count && lists_[std::size_t(first_)].empty()) {
      ++first_;
    }
    return first_ == list_count;
  }
  Candidate take() {
    from_ = first_;
    return lists_[std::size_t(first_)].take();
  }

 private:
  static constexpr int list_count = 6;
  static constexpr int all_lists = -1;

  /// Returns the list of a candidate: its direction from its sponsor.
  int list_of(Candidate candidate) const {
    const std::int64_t difference = std::int64_t{mesh_->neighbours[candidate.entry]} - std::int64_t{candidate.sponsor};
    int axis = 0;
    while (steps_[std::size_t(axis)] != std::abs(difference)) {
      ++axis;
    }
    return 2 * axis + (difference < 0 ? 1 : 0);
  }

  const Mesh* mesh_ = nullptr;
  std::array<std::int64_t, 3> steps_{};  // differences of ids of neighbours along each axis; 0: one element thick
  int from_ = all_lists;                 // the list from which the present sponsor was taken
  int first_ = 0;
  std::array<BackList, list_count> lists_;
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "chainmail/ring.h"
#include "mesh/mesh.h"

namespace chainmail {

/// An element that may have to move, and its sponsor: the element whose move made it a candidate.
struct Candidate {
  EntryId entry;      // in the sponsor's row of the neighbour table: identifies the element and the region
  ElementId sponsor;  // 8 bytes in all
};

// To add an algorithm that differs from others in its list only, add a list here and an entry in algorithms.cpp. A list
// has empty, admit and take; `order` for the replay of a pass; `admits_updated`; and `by_violation` if admit also
// receives how far the candidate lies outside its valid region.

/// The order in which candidates are taken from a list: by their entry, or the largest key first.
enum class TakingOrder { first_in, last_in, by_key };

/// Generalized ChainMail (thesis 3.1, Li and Brodlie 2003): candidates enter at the front, so the last one in is taken
/// first; all are admitted.
class FrontList {
 public:
  static constexpr bool admits_updated = true;
  static constexpr TakingOrder order = TakingOrder::last_in;

  bool empty() const { return candidates_.empty(); }
  void admit(Candidate candidate) { candidates_.push_back(candidate); }
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
struct SpiralList : BackList {
  static constexpr bool admits_updated = true;
  static constexpr TakingOrder order = TakingOrder::first_in;
};

/// Enhanced ChainMail (Schill et al. 1998): the largest violation is taken first, ties by entry; only those not yet
/// updated are admitted. Until a candidate is taken, its element does not move, and its sponsor has been updated: so
/// the violation at entry equals the violation when taken.
class EnhancedList {
 public:
  static constexpr bool admits_updated = false;
  static constexpr TakingOrder order = TakingOrder::by_key;
  static constexpr bool by_violation = true;

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

}  // namespace chainmail

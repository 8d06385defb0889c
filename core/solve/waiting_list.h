#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "solve/ring.h"

namespace chainmail {

/// An element that may have to move, and the element whose move made it so.
struct Candidate {
  EntryId entry;      // in the sponsor's row of the neighbour table; it names the element and the region
  ElementId sponsor;  // 8 bytes in all
};

/// Generalized ChainMail (thesis 3.1, Li and Brodlie 2003): candidates enter at the front, so the last
/// one in is taken first; all are admitted.
class FrontList {
 public:
  static constexpr bool admits_updated = true;

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
};

/// Enhanced ChainMail (Schill et al. 1998): the largest violation is taken first, ties by entry; only
/// those not yet updated are admitted. Until a candidate is taken its element stays, and its sponsor has
/// been updated: the violation at entry is the violation when taken.
class EnhancedList {
 public:
  static constexpr bool admits_updated = false;
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

#pragma once

#include <vector>

#include "solve/body.h"
#include "solve/waiting_list.h"

namespace chainmail {

/// Takes a candidate whose element has not been updated: clamps the element into its valid region about its
/// sponsor, and says whether that moved it. Updated it is in either case (thesis 3.1).
template <class Body, class Observe>
bool update(Body& body, Candidate candidate, std::vector<ElementId>& moved, Observe observe) {
  const ElementId element = body.mesh->neighbours[candidate.entry];
  const bool has_moved = body.clamp(element, candidate.sponsor, candidate.entry);
  body.mark_updated(element);
  observe(element, candidate.sponsor, has_moved);
  if (has_moved) {
    moved.push_back(element);
  }
  return has_moved;
}

/// The propagation that answers a move: one loop for all algorithms that differ in their waiting list.
///
/// The grabbed element stands at its target already. `moved` receives the elements that moved, in order
/// of update, without the grabbed one; `observe(element, sponsor, moved)` is called for every candidate
/// taken and not dropped. Returns the number of those. Each element is updated at most once (thesis 3.1
/// and 4.1; Li and Brodlie 2003).
template <class List, class Body, class Observe>
std::uint64_t propagate(Body& body, List& list, ElementId grabbed, std::vector<ElementId>& moved, Observe observe) {
  const auto admit_neighbours = [&](ElementId sponsor) {
    body.for_each_neighbour(sponsor, [&](ElementId neighbour, EntryId entry) {
      if (List::admits_updated || !body.updated(neighbour)) {
        if constexpr (requires { List::by_violation; }) {
          list.admit({entry, sponsor}, body.violation(neighbour, sponsor, entry));
        } else {
          list.admit({entry, sponsor});
        }
      }
    });
  };
  std::uint64_t checked = 0;
  moved.clear();
  body.begin_pass();
  body.mark_updated(grabbed);
  admit_neighbours(grabbed);
  while (!list.empty()) {
    const Candidate candidate = list.take();
    const ElementId element = body.mesh->neighbours[candidate.entry];
    if (body.updated(element)) {
      continue;
    }
    ++checked;
    if (update(body, candidate, moved, observe)) {
      admit_neighbours(element);
    }
  }
  return checked;
}

}  // namespace chainmail

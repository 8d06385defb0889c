#pragma once

#include <span>
#include <vector>

#include "chainmail/replay.h"

namespace chainmail {

/// The propagation that answers a move: one loop for all algorithms that differ in their waiting list only.
///
/// The elements of the handle (ascending) are at their targets already and count as updated; then their neighbours are
/// admitted, handle element by handle element. `moved` receives the elements that moved, in order of update, without
/// the handle; it must be unchanged since the last pass. `record`, a PassRecord or a substitute, receives the processed
/// candidates. Each element is updated at most once (thesis 3.1 and 4.1; Li and Brodlie 2003).
template <WaitingList List, class Body, class Record>
void propagate(Body& body, List& list, Record& record, std::span<const ElementId> handle,
               std::vector<ElementId>& moved) {
  const auto admit_neighbours = [&](ElementId sponsor) {
    body.for_each_neighbour(sponsor, [&](ElementId neighbour, EntryId entry) {
      const Candidate candidate{entry, sponsor};
      if ((List::admits_updated || !body.updated(neighbour)) && list.admits(candidate)) {
        double violation = 0;
        if constexpr (List::by_violation) {
          violation = body.violation(neighbour, sponsor, entry);
        }
        list.admit(candidate, violation);
      }
    });
  };
  if (record.begin(body, handle, moved, List::by_violation ? Replay::none : Replay::whole)) {
    return;
  }
  list.begin(*body.mesh);
  moved.clear();
  body.begin_pass();
  for (const ElementId element : handle) {
    body.mark_updated(element);
  }
  for (const ElementId element : handle) {
    admit_neighbours(element);
  }
  while (!list.empty()) {
    const Candidate candidate = list.take();
    const ElementId element = body.mesh->neighbours[candidate.entry];
    if (body.updated(element)) {
      continue;
    }
    if (record.update(body, candidate, moved)) {
      admit_neighbours(element);
    }
  }
  record.end();
}

}  // namespace chainmail

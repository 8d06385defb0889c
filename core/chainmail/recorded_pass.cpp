#include "chainmail/recorded_pass.h"

#include <algorithm>

#include "chainmail/follow_pass.h"

namespace chainmail {

std::vector<std::uint32_t> WaitingHistory::at(std::size_t step) const {
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].entered <= step && step < candidates_[i].left) {
      waiting.push_back(i);
    }
  }
  if (order_ == TakingOrder::last_in) {
    std::reverse(waiting.begin(), waiting.end());
  } else if (order_ == TakingOrder::by_key) {
    std::stable_sort(waiting.begin(), waiting.end(), [this](auto a, auto b) { return keys_[a] > keys_[b]; });
  }
  return waiting;
}

/// The queue is the trace of the pass: each element waits once, from the update of its sponsor until its own turn.
WaitingHistory follow_natural_queue(const RecordedPass& pass) {
  std::vector<std::uint32_t> updated_at(pass.mesh->element_count(), no_element);
  std::vector<WaitingCandidate> candidates;
  for (const ElementId element : pass.handle) {
    updated_at[element] = 0;
  }
  for (std::uint32_t row = 0; row < pass.trace.size(); ++row) {
    const auto [element, sponsor, moved] = pass.trace[row];
    if (sponsor == no_element || updated_at[sponsor] == no_element) {
      return {};
    }
    candidates.push_back({element, sponsor, updated_at[sponsor], row + 1, false});
    updated_at[element] = row + 1;
  }
  return {TakingOrder::first_in, std::move(candidates), {}};
}

}  // namespace chainmail

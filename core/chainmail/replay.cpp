#include "chainmail/replay.h"

#include <algorithm>
#include <utility>

namespace chainmail {
namespace {

/// The parts of a body that a record depends on, besides the handle.
Revisions revisions_of_links(const BodyLinks& body) {
  return body.revisions().only({&Revisions::cuts, &Revisions::pins, &Revisions::softness});
}

}  // namespace

bool PassRecord::end_replay(const BodyLinks& body, std::span<const ElementId> handle, std::vector<ElementId>& moved,
                            Replay uses, bool is_known) {
  if (std::exchange(is_predicted_, false) && agreed_ > 0) {
    moved.clear();
    for (const Step& step : steps().first(agreed_)) {
      if (step.has_moved()) {
        moved.push_back(step.element());
      }
    }
  }
  if (agreed_ > 0 && agreed_ == count_) {
    failures_ = 0;
    return true;
  }
  const bool tried = is_known && unused_ == 0;
  if (!is_known || (tried && (uses == Replay::up_to_a_difference || 2 * agreed_ >= count_))) {
    failures_ = unused_ = 0;
  } else if (tried) {
    failures_ = std::min(failures_ + 1, max_failures);
    unused_ = failures_ < 2 ? 0 : 1 << (failures_ - 2);
  } else {
    --unused_;
  }
  made_for_ = revisions_of_links(body);
  handle_.assign(handle.begin(), handle.end());
  next_ = 0;
  return false;
}

void PassRecord::predict(const BodyLinks& body, std::span<const ElementId> handle) {
  make_room(body);
  made_for_ = revisions_of_links(body);
  handle_.assign(handle.begin(), handle.end());
  failures_ = unused_ = 0;
  count_ = next_ = agreed_ = 0;
  is_predicted_ = true;
}

void PassRecord::make_room(const BodyLinks& body) {
  if (!steps_) {
    steps_ = LargeArray<Step>(body.element_count() + 1);
  }
}

void PassRecord::write(Trace& trace) const {
  for (const Step& step : steps()) {
    trace.push_back({step.element(), step.sponsor, step.has_moved()});
  }
}

bool PassRecord::is_of(const BodyLinks& body, std::span<const ElementId> handle) const {
  return revisions_of_links(body) == made_for_ && std::ranges::equal(handle, handle_);
}

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "solve/replay.h"
#include "solve/trace.h"

namespace chainmail {

/// Natural Queue ChainMail (thesis 4.1): first in, first out; only elements not yet updated are admitted.
///
/// Only the first candidate of an element counts; later ones would be dropped. So an element is marked when it is
/// admitted, not when it is taken. Each element waits once, no list is searched, and the queue of a pass lists exactly
/// the processed candidates in order.
///
/// The queue is kept. The next move of the same element usually runs the same way, so the queue is replayed: each
/// candidate is clamped again, as long as it moves, or stays, as before. From the first difference on, the pass runs
/// normally. The result is the same, bit for bit.
template <class Scalar, int Dimension>
class NaturalQueue {
 public:
  using State = Body<Scalar, Dimension>;

  /// Answers the move of the grabbed element, which is at its target already. `moved` receives the elements that moved,
  /// in order of update, without the grabbed one. It must be unchanged since the last pass, unless that pass was
  /// forgotten.
  void propagate(State& body, ElementId grabbed, std::vector<ElementId>& moved) {
    if (grabbed == grabbed_) {
      const std::size_t agreed = replay(body, steps());
      if (agreed < tail_) {
        take_up(body, agreed, moved);
        run(body, agreed, moved);
      }
    } else {
      begin(body, grabbed, moved);
      run(body, 0, moved);
    }
  }

  /// The processed candidates of the last pass, in order.
  std::span<const Step> steps() const { return {queue_.get(), tail_}; }

  /// Call this when the links, the pins, the regions or `moved` were changed by others.
  void forget() { grabbed_ = no_element; }

 private:
  void begin(State& body, ElementId grabbed, std::vector<ElementId>& moved) {
    if (capacity_ < body.positions.size()) {
      capacity_ = body.positions.size();
      queue_ = std::make_unique_for_overwrite<Step[]>(capacity_ + 1);  // unused pages take no memory
    }
    grabbed_ = grabbed;
    moved.clear();
    body.begin_pass();
    body.mark_updated(grabbed);
    tail_ = admit(body, grabbed, queue_.get(), 0);
  }

  /// Admits the neighbours that have not been admitted yet; returns the new end of the queue.
  static std::size_t admit(State& body, ElementId sponsor, Step* queue, std::size_t tail) {
    const std::uint32_t pass = body.pass;
    body.for_each_neighbour(sponsor, [&](ElementId neighbour, EntryId entry) {
      std::uint32_t& update = body.updates[neighbour];
      queue[tail] = {neighbour, sponsor, body.regions.id(entry)};
      tail += update < pass ? 1 : 0;
      update = std::max(update, pass);
    });
    return tail;
  }

  void run(State& body, std::size_t head, std::vector<ElementId>& moved) {
    Step* queue = queue_.get();
    std::size_t tail = tail_;
    for (; head < tail; ++head) {
      Step& step = queue[head];
      const ElementId element = step.element();
      auto& position = body.positions[element];
      const auto next = body.clamped(element, step.sponsor, step.region);
      const bool moves = next != position;
      step.note(moves);
      if (moves) {
        position = next;
        moved.push_back(element);
        tail = admit(body, element, queue, tail);
      }
    }
    tail_ = tail;
  }

  /// Restores the state of the pass at the time when candidate `agreed` was taken.
  void take_up(State& body, std::size_t agreed, std::vector<ElementId>& moved) {
    body.begin_pass();
    body.mark_updated(grabbed_);
    std::size_t moved_count = 0;
    for (std::size_t i = 0; i < agreed; ++i) {
      body.mark_updated(queue_[i].element());
      moved_count += queue_[i].has_moved() ? 1 : 0;
    }
    moved.resize(moved_count);
    // Candidates that were waiting at that time were admitted by elements taken before it.
    std::size_t tail = agreed;
    while (tail < tail_ && body.updated(queue_[tail].sponsor)) {
      ++tail;
    }
    for (std::size_t i = agreed; i < tail; ++i) {
      body.mark_updated(queue_[i].element());
    }
    tail_ = tail;
  }

  std::unique_ptr<Step[]> queue_;
  std::size_t capacity_ = 0;
  std::size_t tail_ = 0;
  ElementId grabbed_ = no_element;
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "chainmail/replay.h"
#include "mesh/progress.h"

namespace chainmail {

/// Natural Queue ChainMail (thesis 4.1): first in, first out; only elements not yet updated are admitted.
///
/// Only the first candidate of an element counts; later ones would be dropped. So an element is marked when it is
/// admitted, not when it is taken. Each element waits once, no list is searched, and the queue of a pass lists exactly
/// the processed candidates in order: it is the record of the pass. Where a replay ends at a difference, the pass goes
/// on from there. The result is the same, bit for bit.
class NaturalQueuePass {
 public:
  NaturalQueuePass(BodyLinks& body, PassRecord& record, std::vector<ElementId>& moved)
      : body_(body), record_(record), queue_(record.queue()), moved_(moved) {}

  /// Lists the steps of a pass in which every element moves.
  void predict(std::span<const ElementId> handle, const Progress& progress) {
    record_.predict(body_, handle);
    mark(handle);
    std::size_t tail = admit_neighbours_of(handle);
    for (std::size_t head = 0; head < tail; ++head) {
      progress.report(head, body_.element_count());
      queue_[head].note(true);
      tail = admit(body_, queue_[head].element(), queue_, tail);
    }
    record_.end(tail);
  }

  /// Runs what the record has not replayed, on a view of the body.
  template <class View>
  void run(const View& view, std::span<const ElementId> handle) {
    mark(handle);
    const std::size_t head = record_.agreed();
    const std::size_t tail = head > 0 ? take_up(head) : begin(handle);
    record_.end(run(view, head, tail));
  }

 private:
  void mark(std::span<const ElementId> handle) {
    body_.begin_pass();
    for (const ElementId element : handle) {
      body_.mark_updated(element);
    }
  }

  std::size_t begin(std::span<const ElementId> handle) {
    moved_.clear();
    return admit_neighbours_of(handle);
  }

  std::size_t admit_neighbours_of(std::span<const ElementId> handle) {
    std::size_t tail = 0;
    for (const ElementId element : handle) {
      tail = admit(body_, element, queue_, tail);
    }
    return tail;
  }

  /// Admits the neighbours that have not been admitted yet; returns the new end of the queue.
  static std::size_t admit(const BodyLinks& body, ElementId sponsor, Step* queue, std::size_t tail) {
    const std::uint32_t pass = body.pass;
    body.for_each_link(sponsor, [&](ElementId neighbour, std::uint32_t region) {
      std::uint32_t& update = body.updates[neighbour];
      queue[tail] = {neighbour, sponsor, region};
      tail += update < pass ? 1 : 0;
      update = std::max(update, pass);
    });
    return tail;
  }

  /// Processes the candidates from `head` on. Returns the end of the queue.
  template <class View>
  std::size_t run(const View& view, std::size_t head, std::size_t tail) {
    const View body = view;
    Step* const queue = queue_;
    for (; head < tail; ++head) {
      Step& step = queue[head];
      const ElementId element = step.element();
      auto& position = body.positions[element];
      const auto next = body.clamped(element, step.sponsor, step.region);
      const bool moves = next != position;
      step.note(moves);
      if (moves) {
        position = next;
        moved_.push_back(element);
        tail = admit(body, element, queue, tail);
      }
    }
    return tail;
  }

  /// Restores the state of the pass at the time when candidate `agreed` was taken. Returns the end of the queue.
  std::size_t take_up(std::size_t agreed) {
    std::size_t moved_count = 0;
    for (std::size_t i = 0; i < agreed; ++i) {
      body_.mark_updated(queue_[i].element());
      moved_count += queue_[i].has_moved() ? 1 : 0;
    }
    moved_.resize(moved_count);
    // Candidates that were waiting at that time were admitted by elements taken before it.
    std::size_t tail = agreed;
    while (tail < record_.steps().size() && body_.updated(queue_[tail].sponsor)) {
      ++tail;
    }
    for (std::size_t i = agreed; i < tail; ++i) {
      body_.mark_updated(queue_[i].element());
    }
    return tail;
  }

  BodyLinks& body_;
  PassRecord& record_;
  Step* queue_;
  std::vector<ElementId>& moved_;
};

struct NaturalQueue {
  /// Answers the move of a handle, as chainmail::propagate() does.
  template <class Scalar, int Dimension>
  void propagate(BodyView<Scalar, Dimension>& body, PassRecord& record, std::span<const ElementId> handle,
                 std::vector<ElementId>& moved) const {
    if (!record.begin(body, handle, moved, Replay::up_to_a_difference)) {
      NaturalQueuePass(body, record, moved).run(body, handle);
    }
  }

  /// Lists the steps of a pass in which every element moves.
  void predict(BodyLinks& body, PassRecord& record, std::span<const ElementId> handle, const Progress& progress) const {
    record.make_room(body);
    std::vector<ElementId> none;
    NaturalQueuePass(body, record, none).predict(handle, progress);
  }
};

}  // namespace chainmail

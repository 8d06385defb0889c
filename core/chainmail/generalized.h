#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "chainmail/replay.h"
#include "mesh/progress.h"

namespace chainmail {

/// The neighbours that an element has admitted and that wait.
struct WaitingRow {
  ElementId sponsor;
  std::uint32_t count;  // 8 bytes in all
};

/// Generalized ChainMail (thesis 3.1, Li and Brodlie 2003): candidates enter at the front of the list, so the last one
/// in is taken first; all are admitted.
///
/// An element that moves admits all its neighbours, and they are next to each other in the list. So the list holds the
/// element, and how many of them have not been taken. The order, and every bit, is that of FrontList.
class GeneralizedPass {
 public:
  GeneralizedPass(BodyLinks& body, PassRecord& record, std::vector<WaitingRow>& list)
      : body_(body), record_(record), list_(list) {}

  /// Runs the pass on a view of the body. The record has carried out its first steps already.
  template <class View>
  void run(const View& view, std::span<const ElementId> handle, std::vector<ElementId>& moved) {
    Step* const steps = record_.queue();
    const std::size_t agreed = record_.agreed();
    moved.clear();
    record_.end(take_all(handle, [&](std::size_t number, const Step& step) {
      const ElementId element = step.element();
      bool moves = false;
      if (number < agreed) {
        moves = steps[number].has_moved();
      } else {
        auto& position = view.positions[element];
        const auto next = view.clamped(element, step.sponsor, step.region);
        moves = next != position;
        position = next;
      }
      if (moves) {
        moved.push_back(element);
      }
      return moves;
    }));
  }

  /// Lists the steps of a pass in which every element moves.
  void predict(std::span<const ElementId> handle, const Progress& progress) {
    record_.predict(body_, handle);
    record_.end(take_all(handle, [&](std::size_t number, const Step& /*step*/) {
      progress.report(number, body_.element_count());
      return true;
    }));
  }

 private:
  /// Takes candidates until none waits. `moves(number, step)` says whether the element of a step moves. Returns the
  /// number of steps.
  template <class Moves>
  std::size_t take_all(std::span<const ElementId> handle, Moves moves) {
    Step* const steps = record_.queue();
    std::size_t count = 0;
    body_.begin_pass();
    list_.clear();
    for (const ElementId element : handle) {
      body_.mark_updated(element);
      list_.push_back({element, body_.links(element).size()});
    }
    while (!list_.empty()) {
      WaitingRow row = list_.back();
      list_.pop_back();
      auto links = body_.links(row.sponsor);
      while (row.count > 0) {
        const auto link = links[--row.count];
        if (body_.updated(link.neighbour) || links.is_cut(row.count)) {
          continue;
        }
        Step step{link.neighbour, row.sponsor, link.region};
        const bool has_moved = moves(count, step);
        step.note(has_moved);
        steps[count++] = step;
        body_.mark_updated(link.neighbour);
        if (has_moved) {  // its neighbours come before the remaining ones
          if (row.count > 0) {
            list_.push_back(row);
          }
          links = body_.links(link.neighbour);
          row = {link.neighbour, links.size()};
        }
      }
    }
    return count;
  }

  BodyLinks& body_;
  PassRecord& record_;
  std::vector<WaitingRow>& list_;
};

/// The algorithm, with a list that it keeps: after warm-up a pass allocates no memory.
class Generalized {
 public:
  /// Answers the move of a handle, as chainmail::propagate() does.
  template <class Scalar, int Dimension>
  void propagate(BodyView<Scalar, Dimension>& body, PassRecord& record, std::span<const ElementId> handle,
                 std::vector<ElementId>& moved) {
    if (!record.begin(body, handle, moved, Replay::whole)) {
      GeneralizedPass(body, record, list_).run(body, handle, moved);
    }
  }

  /// Lists the steps of a pass in which every element moves.
  void predict(BodyLinks& body, PassRecord& record, std::span<const ElementId> handle, const Progress& progress) {
    record.make_room(body);  // the pass keeps a pointer to it
    GeneralizedPass(body, record, list_).predict(handle, progress);
  }

 private:
  std::vector<WaitingRow> list_;
};

}  // namespace chainmail

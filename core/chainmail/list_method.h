#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "body/method.h"
#include "chainmail/generalized.h"
#include "chainmail/natural_queue.h"
#include "chainmail/propagate.h"

namespace chainmail {

/// An algorithm that processes candidates one after another. `Propagation` answers a move as propagate() does.
template <class Propagation, class Scalar, int Dimension>
class ListMethod final : public Method {
 public:
  PassCount move(Body& body, HandleMove& move, PassOutput output) override {
    auto view = body.view<Scalar, Dimension>();
    place_handle(view, move);
    propagation_.propagate(view, record_, move.handle.elements(), output.moved);
    const auto steps = record_.steps();
    if (output.trace != nullptr) {
      std::ranges::transform(steps, std::back_inserter(*output.trace), [](const Step& step) {
        return TraceRow{step.element(), step.sponsor, step.has_moved()};
      });
    }
    return {steps.size(), output.moved.size()};
  }

  void prepare(Body& body, ElementId element, int /*threads*/, const Progress& progress) override {
    auto view = body.view<Scalar, Dimension>();
    if (const std::span handle(&element, 1); !record_.knows(view, handle)) {
      propagation_.predict(view, record_, handle, progress);
    }
  }

 private:
  Propagation propagation_;
  PassRecord record_;
};

/// Stands in for a record while it lists the steps of a pass in which every element moves.
class PredictedPass {
 public:
  PredictedPass(PassRecord& record, const Progress& progress) : record_(record), progress_(progress) {}

  template <class View>
  bool begin(View& body, std::span<const ElementId> handle, std::vector<ElementId>& /*moved*/, Replay /*uses*/) {
    record_.predict(body, handle);
    return false;
  }
  template <class View>
  bool update(View& body, Candidate candidate, std::vector<ElementId>& /*moved*/) {
    progress_.report(count_++, body.positions.size());
    record_.note(body, candidate, true);
    return true;
  }
  void end() { record_.end(); }

 private:
  PassRecord& record_;
  const Progress& progress_;
  std::size_t count_ = 0;
};

/// The common loop with a waiting list.
template <WaitingList List>
struct Propagation {
  template <class View>
  void propagate(View& body, PassRecord& record, std::span<const ElementId> handle, std::vector<ElementId>& moved) {
    chainmail::propagate(body, list, record, handle, moved);
  }

  /// Lists the steps of a pass in which every element moves, unless their order depends on positions.
  template <class View>
  void predict(View& body, PassRecord& record, std::span<const ElementId> handle, const Progress& progress) {
    if constexpr (!List::by_violation) {
      PredictedPass predicted(record, progress);
      std::vector<ElementId> none;
      List own;  // a cancelled pass leaves candidates in it
      chainmail::propagate(body, own, predicted, handle, none);
    }
  }

  List list;
};

template <WaitingList List>
struct ListMethodOf {
  template <class Scalar, int Dimension>
  using Typed = ListMethod<Propagation<List>, Scalar, Dimension>;
};

/// Makes the method of an algorithm that differs from others in its waiting list only.
template <WaitingList List>
inline constexpr auto make_list_method = &make_method<ListMethodOf<List>::template Typed>;

template <class Scalar, int Dimension>
using GeneralizedMethod = ListMethod<Generalized, Scalar, Dimension>;

inline constexpr auto make_generalized = &make_method<GeneralizedMethod>;

template <class Scalar, int Dimension>
using NaturalQueueMethod = ListMethod<NaturalQueue, Scalar, Dimension>;

inline constexpr auto make_natural_queue = &make_method<NaturalQueueMethod>;

}  // namespace chainmail

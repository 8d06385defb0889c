#pragma once

#include <span>
#include <vector>

#include "body/method.h"
#include "chainmail/generalized.h"
#include "chainmail/natural_queue.h"
#include "chainmail/propagate.h"

namespace chainmail {

/// Lists the steps of a pass of one element in which every element moves, unless the record has them.
template <class Propagation>
[[gnu::noinline]] void predict(BodyLinks& body, Propagation& propagation, PassRecord& record, ElementId element,
                               const Progress& progress) {
  if (const std::span handle(&element, 1); !record.knows(body, handle)) {
    propagation.predict(body, record, handle, progress);
  }
}

/// An algorithm that processes candidates one after another. `Propagation` answers a move as propagate() does.
template <class Propagation, class Scalar, int Dimension>
class ListMethod final : public Method {
 public:
  PassCount move(Body& body, HandleMove& move, PassOutput output) override {
    auto view = body.view<Scalar, Dimension>();
    place_handle(view, move);
    propagation_.propagate(view, record_, move.handle.elements(), output.moved);
    if (output.trace != nullptr) {
      record_.write(*output.trace);
    }
    return {record_.steps().size(), output.moved.size()};
  }

  void prepare(Body& body, ElementId element, int /*threads*/, const Progress& progress) override {
    auto view = body.view<Scalar, Dimension>();
    predict(view, propagation_, record_, element, progress);
  }

 private:
  Propagation propagation_;
  PassRecord record_;
};

/// Stands in for a record while it lists the steps of a pass in which every element moves.
class PredictedPass {
 public:
  PredictedPass(PassRecord& record, const Progress& progress) : record_(record), progress_(progress) {}

  bool begin(const BodyLinks& body, std::span<const ElementId> handle, std::vector<ElementId>& /*moved*/,
             Replay /*uses*/) {
    record_.predict(body, handle);
    return false;
  }
  bool update(const BodyLinks& body, Candidate candidate, std::vector<ElementId>& /*moved*/) {
    progress_.report(count_++, body.element_count());
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
  void predict(BodyLinks& body, PassRecord& record, std::span<const ElementId> handle, const Progress& progress) {
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

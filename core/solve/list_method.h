#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "solve/method.h"
#include "solve/natural_queue.h"
#include "solve/propagate.h"

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

 private:
  Propagation propagation_;
  PassRecord record_;
};

/// The common loop with a waiting list.
template <class List>
struct Propagation {
  template <class View>
  void propagate(View& body, PassRecord& record, std::span<const ElementId> handle, std::vector<ElementId>& moved) {
    chainmail::propagate(body, list, record, handle, moved);
  }
  List list;
};

template <class List>
struct ListMethodOf {
  template <class Scalar, int Dimension>
  using Typed = ListMethod<Propagation<List>, Scalar, Dimension>;
};

/// Makes the method of an algorithm that differs from others in its waiting list only.
template <class List>
inline constexpr auto make_list_method = &make_method<ListMethodOf<List>::template Typed>;

template <class Scalar, int Dimension>
using NaturalQueueMethod = ListMethod<NaturalQueue, Scalar, Dimension>;

inline constexpr auto make_natural_queue = &make_method<NaturalQueueMethod>;

}  // namespace chainmail

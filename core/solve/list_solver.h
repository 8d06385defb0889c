#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "solve/natural_queue.h"
#include "solve/original.h"
#include "solve/propagate.h"
#include "solve/solver.h"

namespace chainmail {

/// The algorithms that take one candidate after another, with what their last pass left for the next.
template <class Scalar, int Dimension>
class ListSolver {
 public:
  using State = Body<Scalar, Dimension>;

  /// Sets the grabbed element to a target and propagates; returns what was done, candidate by candidate. `moved`
  /// receives the elements that moved, in order of update, without the grabbed one; it must be as the last pass
  /// left it, unless that was forgotten.
  std::span<const Step> move(State& body, Algorithm algorithm, ElementId grabbed, const Scalar (&target)[Dimension],
                             std::vector<ElementId>& moved) {
    std::copy(std::begin(target), std::end(target), body.places[grabbed].at);
    switch (algorithm) {
      case Algorithm::natural_queue:
        natural_queue_.propagate(body, grabbed, moved);
        return natural_queue_.steps();
      case Algorithm::generalized:
        propagate(body, front_, record_, grabbed, moved);
        break;
      case Algorithm::spiral:
        propagate(body, spiral_, record_, grabbed, moved);
        break;
      case Algorithm::enhanced:
        propagate(body, enhanced_, record_, grabbed, moved);
        break;
      case Algorithm::original:
        directions_.propagate(body, record_, grabbed, moved);
        break;
      default:
        break;  // the others have no list
    }
    return record_.steps();
  }

  /// To be called where the links, the pins, the regions or `moved` were changed by others, and with another
  /// algorithm.
  void forget() {
    record_.forget();
    natural_queue_.forget();
  }

 private:
  NaturalQueue<Scalar, Dimension> natural_queue_;
  PassRecord record_;  // of those below
  FrontList front_;
  SpiralList spiral_;
  EnhancedList enhanced_;
  DirectionLists<> directions_;
};

}  // namespace chainmail

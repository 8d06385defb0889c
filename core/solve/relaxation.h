#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "solve/body.h"
#include "solve/relaxation_result.h"

namespace chainmail {

/// A set of elements that is walked in ascending order; it costs nothing outside the range in use.
class ActiveSet {
 public:
  void insert(ElementId element, std::size_t element_count) {
    words_.resize((element_count + 63) / 64);
    words_[element / 64] |= std::uint64_t{1} << (element % 64);
    first_ = std::min<std::size_t>(first_, element / 64);
    last_ = std::max<std::size_t>(last_, element / 64);
  }

  /// Takes the smallest element out, or says that there is none.
  std::optional<ElementId> take() {
    for (; first_ <= last_ && first_ < words_.size(); ++first_) {
      if (std::uint64_t& word = words_[first_]; word != 0) {
        const auto element = static_cast<ElementId>(64 * first_ + std::countr_zero(word));
        word &= word - 1;
        return element;
      }
    }
    first_ = std::numeric_limits<std::size_t>::max();
    last_ = 0;
    return std::nullopt;
  }

  void clear() {
    while (take()) {
    }
  }

 private:
  std::vector<std::uint64_t> words_;  // a bit an element
  // Nothing is set outside these words.
  std::size_t first_ = std::numeric_limits<std::size_t>::max();
  std::size_t last_ = 0;
};

/// Relaxation `mean`: element by element in ascending id toward the mean, over its neighbours, of their
/// position less the rest vector to them (Frisken-Gibson 1999), each kept in the intersection of its
/// neighbours' valid regions.
///
/// The clamp is this project's: without it relaxation leaves links outside their regions, and the next
/// pass yanks far elements (the jumps of thesis 4.4). From a valid state it keeps every link valid, and
/// with a step in (0, 1] it never raises the energy.
///
/// Only active elements are visited: those that moved, or a neighbour of theirs, since their last visit.
/// Steps below `still` mean rest lengths are not taken and wake nobody, so a scene comes to rest.
template <class Scalar, int Dimension>
class MeanRelaxation {
 public:
  using State = Body<Scalar, Dimension>;
  static constexpr double still = 1e-6;

  /// Makes an element and its neighbours active from the next sweep on.
  void wake(const State& body, ElementId element) {
    next_.insert(element, body.elements.size());
    body.for_each_neighbour(element,
                            [&](ElementId neighbour, EntryId) { next_.insert(neighbour, body.elements.size()); });
  }

  void sleep() {
    current_.clear();
    next_.clear();
    end_sweep();
  }

  /// Goes on with the current sweep, or begins one, until it ends or `budget` elements were visited.
  /// `held` stays where it is.
  RelaxationResult sweep(State& body, double step, std::uint64_t budget, std::optional<ElementId> held) {
    if (!in_sweep_) {
      std::swap(current_, next_);
      in_sweep_ = true;
    }
    RelaxationResult result;
    for (; result.visited < budget; ++result.visited) {
      const auto element = current_.take();
      if (!element) {
        result.sweep_ended = true;
        break;
      }
      visit(body, *element, step, held);
    }
    result.largest_step = largest_step_;
    if (result.sweep_ended) {
      end_sweep();
    }
    return result;
  }

 private:
  void end_sweep() {
    in_sweep_ = false;
    largest_step_ = 0;
  }

  void visit(State& body, ElementId element, double step, std::optional<ElementId> held) {
    const double taken = element == held ? 0 : relax(body, element, static_cast<Scalar>(step));
    if (taken == 0) {
      return;
    }
    largest_step_ = std::max(largest_step_, taken);
    if (step < 1) {
      next_.insert(element, body.elements.size());
    }
    // A neighbour with a larger id is still to come in this sweep, one with a smaller id in the next.
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId) {
      (neighbour > element ? current_ : next_).insert(neighbour, body.elements.size());
    });
  }

  /// Takes one element's step; returns its length (mesh units), 0 where it stayed.
  double relax(State& body, ElementId element, Scalar step) const {
    Scalar mean[Dimension]{}, low[Dimension], high[Dimension];
    std::fill(std::begin(low), std::end(low), -std::numeric_limits<Scalar>::infinity());
    std::fill(std::begin(high), std::end(high), std::numeric_limits<Scalar>::infinity());
    int count = 0;
    const double* rest = body.mesh->rest.data();
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId entry) {
      const Scalar* about = body.elements[neighbour].position;
      for (int k = 0; k < Dimension; ++k) {
        const auto rest_vector = static_cast<Scalar>(rest[std::size_t{neighbour} * Dimension + k] -
                                                     rest[std::size_t{element} * Dimension + k]);
        mean[k] += about[k] - rest_vector;
        low[k] = std::max(low[k], about[k] - body.regions[entry].high[k]);
        high[k] = std::min(high[k], about[k] - body.regions[entry].low[k]);
      }
      ++count;
    });
    if (count == 0) {
      return 0;
    }
    Scalar* x = body.elements[element].position;
    Scalar next[Dimension];
    double square = 0;
    for (int k = 0; k < Dimension; ++k) {
      next[k] = x[k] + step * (mean[k] / static_cast<Scalar>(count) - x[k]);
      next[k] = low[k] > high[k] ? x[k] : std::min(std::max(next[k], low[k]), high[k]);
      const double difference = double(next[k]) - double(x[k]);
      square += difference * difference;
    }
    const double threshold = still * body.mesh->mean_link_length;
    if (!(square > threshold * threshold)) {
      return 0;
    }
    std::copy(std::begin(next), std::end(next), x);
    return std::sqrt(square);
  }

  ActiveSet current_;  // still to come in this sweep
  ActiveSet next_;     // to come in the next
  bool in_sweep_ = false;
  double largest_step_ = 0;  // of this sweep (mesh units)
};

}  // namespace chainmail

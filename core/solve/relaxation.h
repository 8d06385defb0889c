#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "solve/body.h"
#include "solve/relaxation_result.h"

namespace chainmail {

/// A set of elements, taken in ascending order. Costs nothing outside the range in use.
class ActiveSet {
 public:
  void insert(ElementId element, std::size_t element_count) {
    words_.resize((element_count + 63) / 64);
    words_[element / 64] |= std::uint64_t{1} << (element % 64);
    first_ = std::min<std::size_t>(first_, element / 64);
    last_ = std::max<std::size_t>(last_, element / 64);
  }

  void insert_all(std::size_t element_count) {
    words_.assign((element_count + 63) / 64, ~std::uint64_t{0});
    if (element_count % 64 != 0) {
      words_.back() = (std::uint64_t{1} << (element_count % 64)) - 1;
    }
    first_ = 0;
    last_ = words_.size() - 1;
  }

  /// Removes and returns the smallest element, if any.
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
    for (; first_ <= last_ && first_ < words_.size(); ++first_) {
      words_[first_] = 0;
    }
    first_ = std::numeric_limits<std::size_t>::max();
    last_ = 0;
  }

 private:
  std::vector<std::uint64_t> words_;  // one bit per element
  // All words outside this range are 0.
  std::size_t first_ = std::numeric_limits<std::size_t>::max();
  std::size_t last_ = 0;
};

/// Relaxation of the elastic energy, element by element in ascending id. `mean` moves an element toward the mean, over
/// its neighbours, of their position less the rest vector to them. `link` moves an element and each neighbour of higher
/// id half the way each toward their rest vector. Each element stays inside the intersection of its neighbours' valid
/// regions, axis by axis; on an axis where that is empty it does not move.
///
/// The clamp is this project's: without it, relaxation leaves links outside their regions, and the next pass pulls far
/// elements abruptly (the jumps of thesis 4.4). From a valid state it keeps every link valid, and `mean` with a step in
/// (0, 1] never raises the energy. `link` may, and if links contradict each other it may never end.
///
/// Only active elements are visited: elements that moved, or a neighbour of which moved, since their last visit. Steps
/// below `still` mean rest lengths are not taken and make nothing active, so a scene comes to rest.
template <class Scalar, int Dimension>
class Relaxation {
 public:
  using State = Body<Scalar, Dimension>;
  static constexpr double still = 1e-6;

  /// Makes an element and its neighbours active from the next sweep on.
  void wake(const State& body, ElementId element) {
    next_.insert(element, body.positions.size());
    body.for_each_neighbour(element,
                            [&](ElementId neighbour, EntryId) { next_.insert(neighbour, body.positions.size()); });
  }

  void wake_all(const State& body) { next_.insert_all(body.positions.size()); }

  void sleep() {
    current_.clear();
    next_.clear();
    end_sweep();
  }

  /// Continues the current sweep, or begins one, until it ends or `budget` elements were visited. `held` and pinned
  /// elements stay.
  RelaxationResult sweep(State& body, RelaxationScheme scheme, double step, std::uint64_t budget,
                         std::optional<ElementId> held) {
    if (!in_sweep_) {
      std::swap(current_, next_);
      in_sweep_ = true;
    }
    moved_.clear();
    RelaxationResult result;
    for (; result.visited < budget; ++result.visited) {
      const auto element = current_.take();
      if (!element) {
        result.sweep_ended = true;
        break;
      }
      if (scheme == RelaxationScheme::mean) {
        visit(body, *element, step, held);
      } else {
        visit_links(body, *element, step, held);
      }
    }
    result.largest_step = largest_step_;
    if (result.sweep_ended) {
      end_sweep();
    }
    return result;
  }

  /// The elements that the last slice moved, once per move.
  std::span<const ElementId> moved() const { return moved_; }

 private:
  void end_sweep() {
    in_sweep_ = false;
    largest_step_ = 0;
  }

  using Position = std::array<Scalar, Dimension>;

  /// Returns a neighbour's position less the rest vector to it: the position that this link alone implies.
  static Position position_by(const State& body, ElementId element, ElementId neighbour) {
    const double* rest = body.mesh->rest.data();
    Position position;
    for (int k = 0; k < Dimension; ++k) {
      const double rest_vector =
          body.from_rest ? 0
                         : rest[std::size_t{neighbour} * Dimension + k] - rest[std::size_t{element} * Dimension + k];
      position[k] = body.positions[neighbour][k] - static_cast<Scalar>(rest_vector);
    }
    return position;
  }

  static bool stays(const State& body, ElementId element, std::optional<ElementId> held) {
    return element == held || body.pinned(element);
  }

  void visit(State& body, ElementId element, double step, std::optional<ElementId> held) {
    if (stays(body, element, held)) {
      return;
    }
    Position mean{};
    int count = 0;
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId) {
      const Position position = position_by(body, element, neighbour);
      for (int k = 0; k < Dimension; ++k) {
        mean[k] += position[k];
      }
      ++count;
    });
    if (count == 0) {
      return;
    }
    for (Scalar& x : mean) {
      x /= static_cast<Scalar>(count);
    }
    if (go(body, element, mean, static_cast<Scalar>(step), element) && step < 1) {
      next_.insert(element, body.positions.size());
    }
  }

  /// Relaxes the links to neighbours of higher id: each link once per sweep, in the order of links.
  void visit_links(State& body, ElementId element, double step, std::optional<ElementId> held) {
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId) {
      if (neighbour < element) {
        return;
      }
      const Position here = position_by(body, element, neighbour), there = position_by(body, neighbour, element);
      const Scalar half = static_cast<Scalar>(step) / 2;
      for (const auto& [one, position] : {std::pair(element, here), std::pair(neighbour, there)}) {
        if (!stays(body, one, held) && go(body, one, position, half, element)) {
          next_.insert(element, body.positions.size());
        }
      }
    });
  }

  /// Moves an element a step toward a position, as far as its neighbours' regions allow, and wakes its neighbours.
  /// Returns true if it moved. Elements with a larger id than the visited one are visited in this sweep, the others in
  /// the next.
  bool go(State& body, ElementId element, const Position& position, Scalar step, ElementId visited) {
    const double taken = take_step(body, element, position, step);
    if (taken == 0) {
      return false;
    }
    largest_step_ = std::max(largest_step_, taken);
    moved_.push_back(element);
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId) {
      (neighbour > visited ? current_ : next_).insert(neighbour, body.positions.size());
    });
    if (element > visited) {
      current_.insert(element, body.positions.size());
    }
    return true;
  }

  /// Returns the length of the step (mesh units), 0 if the element stayed.
  static double take_step(State& body, ElementId element, const Position& position, Scalar step) {
    Position low, high;
    low.fill(-std::numeric_limits<Scalar>::infinity());
    high.fill(std::numeric_limits<Scalar>::infinity());
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId entry) {
      const Scalar* about = body.positions[neighbour].at;
      for (int k = 0; k < Dimension; ++k) {
        low[k] = std::max(low[k], about[k] - body.regions[entry].high[k]);
        high[k] = std::min(high[k], about[k] - body.regions[entry].low[k]);
      }
    });
    Scalar* x = body.positions[element].at;
    Position next;
    double square = 0;
    for (int k = 0; k < Dimension; ++k) {
      next[k] = x[k] + step * (position[k] - x[k]);
      next[k] = low[k] > high[k] ? x[k] : std::min(std::max(next[k], low[k]), high[k]);
      const double difference = double(next[k]) - double(x[k]);
      square += difference * difference;
    }
    const double threshold = still * body.mesh->mean_link_length;
    if (!(square > threshold * threshold)) {
      return 0;
    }
    std::copy(next.begin(), next.end(), x);
    return std::sqrt(square);
  }

  ActiveSet current_;  // to be visited in this sweep
  ActiveSet next_;     // to be visited in the next sweep
  std::vector<ElementId> moved_;
  bool in_sweep_ = false;
  double largest_step_ = 0;  // of this sweep (mesh units)
};

}  // namespace chainmail

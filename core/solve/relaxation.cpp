#include "solve/relaxation.h"

#include <array>
#include <cmath>
#include <utility>

#include "solve/body_view.h"

namespace chainmail {

/// The visits of one slice.
template <class View>
class Relaxation::Slice {
 public:
  using Scalar = typename View::Scalar;
  static constexpr int Dimension = View::Dimension;

  Slice(Relaxation& relaxation, const View& body, double step, std::span<const ElementId> held)
      : relaxation_(relaxation), body_(body), step_(step), held_(held) {}

  RelaxationResult run(std::uint64_t budget) {
    RelaxationResult result;
    for (; result.visited < budget; ++result.visited) {
      const auto element = relaxation_.current_.take();
      if (!element) {
        result.sweep_ended = true;
        break;
      }
      relaxation_.scheme_ == RelaxationScheme::mean ? visit(*element) : visit_links(*element);
    }
    result.largest_step = relaxation_.largest_step_;
    return result;
  }

 private:
  using Coordinates = std::array<Scalar, Dimension>;

  /// Returns a neighbour's position less the rest vector to it: the position that this link alone implies.
  Coordinates position_by(ElementId element, ElementId neighbour) const {
    const double* rest = body_.mesh->rest.data();
    Coordinates position;
    for (int k = 0; k < Dimension; ++k) {
      const double rest_vector =
          body_.from_rest ? 0
                          : rest[std::size_t{neighbour} * Dimension + k] - rest[std::size_t{element} * Dimension + k];
      position[k] = body_.positions[neighbour][k] - static_cast<Scalar>(rest_vector);
    }
    return position;
  }

  bool stays(ElementId element) const {
    return body_.pinned(element) ||
           (held_.size() < 2 ? !held_.empty() && held_[0] == element : std::ranges::binary_search(held_, element));
  }

  void wake_next(ElementId element) { relaxation_.next_.insert(element, body_.positions.size()); }

  void visit(ElementId element) {
    if (stays(element)) {
      return;
    }
    Coordinates mean{};
    int count = 0;
    body_.for_each_neighbour(element, [&](ElementId neighbour, EntryId) {
      const Coordinates position = position_by(element, neighbour);
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
    if (go(element, mean, static_cast<Scalar>(step_), element) && step_ < 1) {
      wake_next(element);
    }
  }

  /// Relaxes the links to neighbours of higher id: each link once per sweep, in the order of links.
  void visit_links(ElementId element) {
    body_.for_each_neighbour(element, [&](ElementId neighbour, EntryId) {
      if (neighbour < element) {
        return;
      }
      const Coordinates here = position_by(element, neighbour), there = position_by(neighbour, element);
      const Scalar half = static_cast<Scalar>(step_) / 2;
      for (const auto& [one, position] : {std::pair(element, here), std::pair(neighbour, there)}) {
        if (!stays(one) && go(one, position, half, element)) {
          wake_next(element);
        }
      }
    });
  }

  /// Moves an element a step toward a position, as far as its neighbours' regions allow, and wakes its neighbours.
  /// Returns true if it moved. Elements with a larger id than the visited one are visited in this sweep, the others in
  /// the next.
  bool go(ElementId element, const Coordinates& position, Scalar step, ElementId visited) {
    const double taken = take_step(element, position, step);
    if (taken == 0) {
      return false;
    }
    relaxation_.largest_step_ = std::max(relaxation_.largest_step_, taken);
    relaxation_.moved_.push_back(element);
    body_.for_each_neighbour(element, [&](ElementId neighbour, EntryId) {
      (neighbour > visited ? relaxation_.current_ : relaxation_.next_).insert(neighbour, body_.positions.size());
    });
    if (element > visited) {
      relaxation_.current_.insert(element, body_.positions.size());
    }
    return true;
  }

  /// Returns the length of the step (mesh units), 0 if the element stayed.
  double take_step(ElementId element, const Coordinates& position, Scalar step) {
    Coordinates low, high;
    low.fill(-std::numeric_limits<Scalar>::infinity());
    high.fill(std::numeric_limits<Scalar>::infinity());
    body_.for_each_neighbour(element, [&](ElementId neighbour, EntryId entry) {
      const Scalar* about = body_.positions[neighbour].at;
      for (int k = 0; k < Dimension; ++k) {
        low[k] = std::max(low[k], about[k] - body_.regions[entry].high[k]);
        high[k] = std::min(high[k], about[k] - body_.regions[entry].low[k]);
      }
    });
    Scalar* x = body_.positions[element].at;
    Coordinates next;
    double square = 0;
    for (int k = 0; k < Dimension; ++k) {
      next[k] = x[k] + step * (position[k] - x[k]);
      next[k] = low[k] > high[k] ? x[k] : std::min(std::max(next[k], low[k]), high[k]);
      const double difference = double(next[k]) - double(x[k]);
      square += difference * difference;
    }
    const double threshold = still * body_.mesh->mean_link_length;
    if (!(square > threshold * threshold)) {
      return 0;
    }
    std::copy(next.begin(), next.end(), x);
    return std::sqrt(square);
  }

  Relaxation& relaxation_;
  const View body_;
  double step_;
  std::span<const ElementId> held_;
};

void Relaxation::follow(const Body& body) {
  if (positions_ != body.revisions().positions) {
    positions_ = body.revisions().positions;
    sleep();
  }
}

void Relaxation::wake(const Body& body, std::span<const ElementId> elements) {
  follow(body);
  for (const ElementId element : elements) {
    next_.insert(element, body.mesh().element_count());
    for_each_neighbour(body.mesh(), body.cuts(), element,
                       [&](ElementId neighbour, EntryId) { next_.insert(neighbour, body.mesh().element_count()); });
  }
}

void Relaxation::wake_all(const Body& body) {
  follow(body);
  next_.insert_all(body.mesh().element_count());
}

void Relaxation::sleep() {
  current_.clear();
  next_.clear();
  end_sweep();
}

RelaxationResult Relaxation::sweep(Body& body, double step, std::uint64_t budget, std::span<const ElementId> held) {
  follow(body);
  if (!in_sweep_) {
    std::swap(current_, next_);
    in_sweep_ = true;
  }
  moved_.clear();
  const RelaxationResult result =
      body.with_view([&]<class View>(const View& view) { return Slice<View>(*this, view, step, held).run(budget); });
  if (result.largest_step > 0) {
    body.note_relaxation();
  }
  if (result.sweep_ended) {
    end_sweep();
  }
  return result;
}

void Relaxation::end_sweep() {
  in_sweep_ = false;
  largest_step_ = 0;
}

}  // namespace chainmail

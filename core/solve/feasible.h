#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <vector>

#include "mesh/error.h"
#include "solve/body.h"

namespace chainmail {

/// Lowers labels, one an element, until label_j ≤ label_i + weight(i, j, entry) on every link that is not
/// cut (Dijkstra 1959); weights are not below 0, elements with a finite label are the sources. Stops early
/// at the first element, nearest first, for which `is_end` says so, and returns it.
template <class Body, class Weight, class IsEnd>
std::optional<ElementId> shorten_paths(const Body& body, std::vector<typename Body::Scalar>& labels, Weight weight,
                                       IsEnd is_end) {
  using Scalar = typename Body::Scalar;
  using Entry = std::pair<Scalar, ElementId>;
  std::vector<Entry> sources;
  for (ElementId e = 0; e < labels.size(); ++e) {
    if (labels[e] < std::numeric_limits<Scalar>::infinity()) {
      sources.emplace_back(labels[e], e);
    }
  }
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>(), std::move(sources));
  while (!queue.empty()) {
    const auto [label, element] = queue.top();
    queue.pop();
    if (label > labels[element]) {
      continue;
    }
    if (is_end(element)) {
      return element;
    }
    body.for_each_neighbour(element, [&, from = label, sponsor = element](ElementId neighbour, EntryId entry) {
      const Scalar through = from + weight(sponsor, neighbour, entry);
      if (through < labels[neighbour]) {
        labels[neighbour] = through;
        queue.emplace(through, neighbour);
      }
    });
  }
  return std::nullopt;
}

/// Makes a body that holds displacements from rest valid, whatever state it is in: the start that Exact
/// ChainMail needs after softness was edited under load or another algorithm left its state.
///
/// Anchors, the pins and the grabbed element, stay. Every displacement is clamped to what the anchors
/// allow; then the least and the greatest valid answer about the result are taken and halved between, so
/// that no order of elements or links matters. An axis at a time; links are difference constraints, their
/// shortest paths distances over the bounds, and the rest shape makes every weight non-negative.
template <class Scalar, int Dimension>
class Repair {
 public:
  using State = Body<Scalar, Dimension>;

  explicit Repair(State& body) : body_(body) {}

  /// Whether every link holds, up to what rounding does to displacements of this size.
  bool is_valid() const {
    for (ElementId e = 0; e < body_.mesh->element_count(); ++e) {
      bool holds = true;
      body_.for_each_neighbour(
          e, [&](ElementId n, EntryId entry) { holds = holds && (n < e || link_holds(e, n, entry)); });
      if (!holds) {
        return false;
      }
    }
    return true;
  }

  /// Throws Error, naming them, where two pins are further apart than links allow; nothing has moved then.
  void run(std::span<const ElementId> pins, ElementId grabbed) {
    std::vector<Scalar> result[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      result[k] = axis(pins, grabbed, k);
    }
    for (ElementId e = 0; e < body_.mesh->element_count(); ++e) {
      for (int k = 0; k < Dimension && !body_.pinned(e); ++k) {
        body_.elements[e].position[k] = result[k][e];
      }
    }
  }

 private:
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  using Labels = std::vector<Scalar>;

  bool link_holds(ElementId a, ElementId b, EntryId entry) const {
    for (int k = 0; k < Dimension; ++k) {
      const Scalar from = body_.elements[a].position[k], to = body_.elements[b].position[k];
      const Scalar rounding = 8 * std::numeric_limits<Scalar>::epsilon() * std::max(std::abs(from), std::abs(to));
      if (to - from < body_.regions[entry].low[k] - rounding || to - from > body_.regions[entry].high[k] + rounding) {
        return false;
      }
    }
    return true;
  }

  /// How far up the links let each element stand, given how far the others do.
  void lower(Labels& labels, int k) const {
    shorten_paths(
        body_, labels, [&](ElementId, ElementId, EntryId entry) { return body_.regions[entry].high[k]; },
        [](ElementId) { return false; });
  }
  /// The same downward, with labels negated.
  void lower_mirrored(Labels& labels, int k) const {
    shorten_paths(
        body_, labels, [&](ElementId, ElementId, EntryId entry) { return -body_.regions[entry].low[k]; },
        [](ElementId) { return false; });
  }

  Labels from_anchors(const Labels& u, std::span<const ElementId> anchors, Scalar sign) const {
    Labels labels(u.size(), infinity);
    for (const ElementId anchor : anchors) {
      labels[anchor] = sign * u[anchor];
    }
    return labels;
  }

  /// Clamps to what the anchors allow.
  void clamp(Labels& u, std::span<const ElementId> anchors, int k) const {
    Labels high = from_anchors(u, anchors, 1), low = from_anchors(u, anchors, -1);
    lower(high, k);
    lower_mirrored(low, k);
    for (std::size_t e = 0; e < u.size(); ++e) {
      u[e] = std::min(std::max(u[e], -low[e]), high[e]);
    }
  }

  Labels axis(std::span<const ElementId> pins, ElementId grabbed, int k) const {
    Labels u(body_.elements.size());
    for (std::size_t e = 0; e < u.size(); ++e) {
      u[e] = body_.elements[e].position[k];
    }
    std::vector<ElementId> anchors(pins.begin(), pins.end());
    if (!pins.empty()) {
      const Labels before = u;
      clamp(u, anchors, k);  // the hand's element as well: it goes where the pins let it be
      check_pins(before, u, pins, k);
      const Scalar hand = u[grabbed];
      u = before;
      u[grabbed] = hand;
    }
    anchors.push_back(grabbed);
    clamp(u, anchors, k);
    Labels low(u.size());
    std::transform(u.begin(), u.end(), low.begin(), [](Scalar x) { return -x; });
    lower(u, k);
    lower_mirrored(low, k);
    std::transform(u.begin(), u.end(), low.begin(), u.begin(), [](Scalar up, Scalar down) { return (up - down) / 2; });
    return u;
  }

  void check_pins(const Labels& before, const Labels& clamped, std::span<const ElementId> pins, int k) const {
    for (const ElementId pin : pins) {
      const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * std::abs(before[pin]) +
                              static_cast<Scalar>(1e-6 * body_.mesh->mean_link_length);
      if (!(std::abs(clamped[pin] - before[pin]) <= rounding)) {
        refuse_pins(before, pins, pin, k);
      }
    }
  }

  /// Finds the pin that pulls or pushes this one away, and says so.
  [[noreturn]] void refuse_pins(const Labels& u, std::span<const ElementId> pins, ElementId pin, int k) const {
    ElementId other = pin;
    Scalar worst = 0;
    for (const ElementId one : pins) {
      Labels high = from_anchors(u, {&one, 1}, 1), low = from_anchors(u, {&one, 1}, -1);
      lower(high, k);
      lower_mirrored(low, k);
      const Scalar outside = std::max(u[pin] - high[pin], -low[pin] - u[pin]);
      if (outside > worst) {
        worst = outside;
        other = one;
      }
    }
    throw Error("pins " + std::to_string(std::min(pin, other)) + " and " + std::to_string(std::max(pin, other)),
                "they contradict each other: the links between them cannot span them where they are",
                "unpin one of them, or soften the object");
  }

  State& body_;
};

}  // namespace chainmail

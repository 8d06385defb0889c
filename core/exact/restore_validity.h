#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/body_view.h"
#include "mesh/error.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Shortest paths along links (Dijkstra 1959), in double. A search costs only what it touches; its memory is reused by
/// the next one.
class PathSearch {
 public:
  static constexpr double unreached = std::numeric_limits<double>::infinity();

  void begin(ElementId element_count) {
    if (labels_.size() != element_count) {
      labels_.assign(element_count, unreached);
      hops_.assign(element_count, 0);
    } else {
      for (const ElementId element : touched_) {
        labels_[element] = unreached;
      }
    }
    touched_.clear();
    heap_.clear();
  }

  void add_source(ElementId element, double label) { lower(element, label, 0); }

  /// Lowers labels until label_j ≤ label_i + weight(i, j, entry) on every link that is not cut. Weights must be 0 or
  /// more.
  template <class Body, class Weight>
  void run(const Body& body, Weight weight) {
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
      const auto [label, element] = heap_.back();
      heap_.pop_back();
      if (label > labels_[element]) {
        continue;
      }
      body.for_each_neighbour(element, [&, from = label, sponsor = element](ElementId neighbour, EntryId entry) {
        const double through = from + weight(sponsor, neighbour, entry);
        if (through < labels_[neighbour]) {
          lower(neighbour, through, hops_[sponsor] + 1);
        }
      });
    }
  }

  /// Length of the shortest path to an element, including the source's label, and its number of links.
  double label(ElementId element) const { return labels_[element]; }
  std::uint32_t hops(ElementId element) const { return hops_[element]; }

 private:
  void lower(ElementId element, double label, std::uint32_t hops) {
    if (labels_[element] == unreached) {
      touched_.push_back(element);
    }
    labels_[element] = label;
    hops_[element] = hops;
    heap_.emplace_back(label, element);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }

  std::vector<double> labels_;
  std::vector<std::uint32_t> hops_;
  std::vector<ElementId> touched_;
  std::vector<std::pair<double, ElementId>> heap_;
};

/// The error about two pins that are further apart than links allow.
inline Error contradiction(ElementId pin, ElementId other) {
  return Error("pins " + std::to_string(std::min(pin, other)) + " and " + std::to_string(std::max(pin, other)),
               "they contradict each other: the links between them do not allow their positions",
               "unpin one of them, or soften the object");
}

/// Makes any state of a body that stores displacements valid: Exact ChainMail needs this after softness was edited
/// under load or another algorithm left its state.
///
/// Anchors, which are the pins and the elements of the handle, stay as far as they can. Links inside a handle of many
/// do not count: the handle holds their ends. Every displacement is clamped to what the anchors allow. Then the result
/// is the mean of the least and the greatest valid answer about it, so no order of elements or links matters. One axis
/// at a time, in double. Links are difference constraints, their shortest paths are distances over the bounds, and the
/// rest shape makes every weight non-negative.
///
/// `State` is a BodyView, or something else with positions, regions, pins and neighbours.
template <class State>
class RestoreValidity {
 public:
  using Scalar = typename State::Scalar;
  static constexpr int Dimension = State::Dimension;

  /// `reach`: the largest displacement or move that led to the state (mesh units). `handle`: its elements, ascending.
  /// `epsilon`: relative rounding error of the numbers that the state was made of.
  RestoreValidity(State& body, PathSearch& search, double reach, std::span<const ElementId> handle,
                  double epsilon = std::numeric_limits<Scalar>::epsilon())
      : body_(body), search_(search), reach_(reach), handle_(handle), epsilon_(epsilon) {}

  /// Returns true if every link is valid, up to rounding of displacements of this size and, within an invisible
  /// tolerance, up to rounding of the displacements that led to the state.
  [[gnu::noinline]] bool is_valid() const {
    for (ElementId e = 0; e < body_.mesh->element_count(); ++e) {
      bool holds = true;
      body_.for_each_neighbour(e, [&](ElementId n, EntryId entry) {
        holds = holds && (n < e || is_inner(e, n) || link_holds(e, n, entry));
      });
      if (!holds) {
        return false;
      }
    }
    return true;
  }

  /// Restores the state. Throws Error, with the pins, if two pins are further apart than links allow; nothing has moved
  /// then.
  [[gnu::noinline]] void run(std::span<const ElementId> pins) {
    Labels result[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      result[k] = axis(pins, k);
    }
    for (ElementId e = 0; e < body_.mesh->element_count(); ++e) {
      for (int k = 0; k < Dimension && !body_.pinned(e); ++k) {
        body_.positions[e][k] = static_cast<Scalar>(result[k][e]);
      }
    }
  }

 private:
  using Labels = std::vector<double>;
  enum class Side { up, down };

  bool is_inner(ElementId a, ElementId b) const { return handle_.size() > 1 && is_held(a) && is_held(b); }
  bool is_held(ElementId element) const { return std::ranges::binary_search(handle_, element); }

  /// Invisible tolerance: half of the smallest reported violation, for links of average length (mesh units).
  double unseen() const { return 5e-5 * body_.mesh->mean_link_length; }

  bool link_holds(ElementId a, ElementId b, EntryId entry) const {
    for (int k = 0; k < Dimension; ++k) {
      const Scalar from = body_.positions[a][k], to = body_.positions[b][k];
      const double size = std::max(std::abs(double(from)), std::abs(double(to)));
      const double rounding = std::max(8 * epsilon_ * size, std::min(8 * epsilon_ * reach_, unseen()));
      const auto& region = body_.regions[entry];
      // NaN counts as a violation.
      const double apart = double(to) - double(from);
      if (!(apart >= double(region.low[k]) - rounding && apart <= double(region.high[k]) + rounding)) {
        return false;
      }
    }
    return true;
  }

  /// Computes the highest position to which links let every element go, from all sources together; for Side::down the
  /// lowest one, negated.
  [[gnu::noinline]] void search(const Labels& u, std::span<const ElementId> sources, Side side, int k) {
    search_.begin(body_.mesh->element_count());
    for (const ElementId source : sources) {
      search_.add_source(source, side == Side::up ? u[source] : -u[source]);
    }
    search_.run(body_, [&](ElementId from, ElementId to, EntryId entry) {
      if (is_inner(from, to)) {
        return PathSearch::unreached;
      }
      const auto& region = body_.regions[entry];
      return double(side == Side::up ? region.high[k] : -region.low[k]);
    });
  }

  /// Clamps displacements to the range that the anchors allow.
  void clamp(Labels& u, const std::vector<ElementId>& anchors, int k) {
    const Labels positions = u;
    search(positions, anchors, Side::down, k);
    for (ElementId e = 0; e < u.size(); ++e) {
      u[e] = std::max(u[e], -search_.label(e));
    }
    search(positions, anchors, Side::up, k);
    for (ElementId e = 0; e < u.size(); ++e) {
      u[e] = std::min(u[e], search_.label(e));
    }
  }

  Labels axis(std::span<const ElementId> pins, int k) {
    Labels u(body_.positions.size());
    for (std::size_t e = 0; e < u.size(); ++e) {
      u[e] = double(body_.positions[e][k]);
    }
    std::vector<ElementId> anchors(pins.begin(), pins.end());
    if (!pins.empty()) {
      const Labels before = u;
      clamp(u, anchors, k);
      check_pins(before, u, pins, k);
      const Labels allowed = std::exchange(u, before);
      for (const ElementId element : handle_) {
        u[element] = allowed[element];  // the handle moves to where the pins allow it
      }
    }
    anchors.insert(anchors.end(), handle_.begin(), handle_.end());
    clamp(u, anchors, k);
    return between_envelopes(u, k);
  }

  Labels between_envelopes(const Labels& u, int k) {
    std::vector<ElementId> all(u.size());
    for (ElementId e = 0; e < u.size(); ++e) {
      all[e] = e;
    }
    Labels between(u.size());
    for (const Side side : {Side::up, Side::down}) {
      search(u, all, side, k);
      for (ElementId e = 0; e < u.size(); ++e) {
        between[e] += search_.label(e) / (side == Side::up ? 2 : -2);
      }
    }
    return between;
  }

  void check_pins(const Labels& before, const Labels& clamped, std::span<const ElementId> pins, int k) {
    for (const ElementId pin : pins) {
      if (clamped[pin] != before[pin]) {
        check_pin(before, pins, pin, k);
      }
    }
  }

  /// Throws Error if another pin pulls or pushes this one away by more than rounding explains: a pass moves an element
  /// off by half an ulp for each link of its path.
  void check_pin(const Labels& u, std::span<const ElementId> pins, ElementId pin, int k) {
    ElementId worst = pin;
    double most = 0;
    for (const Side side : {Side::up, Side::down}) {
      search(u, std::span(&pin, 1), side, k);
      for (const ElementId other : pins) {
        const double size = std::max({std::abs(u[pin]), std::abs(u[other]), reach_});
        const double rounding = epsilon_ * size * (search_.hops(other) + 8.0);
        const double outside = (side == Side::up ? u[other] : -u[other]) - search_.label(other);
        if (outside > std::max(rounding, most)) {
          most = outside;
          worst = other;
        }
      }
    }
    if (worst != pin) {
      throw contradiction(pin, worst);
    }
  }

  State& body_;
  PathSearch& search_;
  double reach_;
  std::span<const ElementId> handle_;
  double epsilon_;
};

}  // namespace chainmail

#pragma once

#include <algorithm>
#include <array>
#include <list>
#include <vector>

#include "reference/object.h"

namespace reference {

/// Thesis 4.2: Waiting_List_Data = { element, sponsor }.
struct WaitingListData {
  ElementId element;
  ElementId sponsor;
};

/// A candidate that was taken from the waiting list and not dropped.
struct Processed {
  ElementId element;
  ElementId sponsor;
  bool moved;

  bool operator==(const Processed&) const = default;
};

/// Generalized ChainMail (thesis 3.1): each neighbour is added to the front of the waiting list.
struct GeneralizedChainMail {
  template <class Scalar>
  static void add_neighbours(Object<Scalar>& object, ElementId sponsor, std::list<WaitingListData>& waiting_list) {
    for (const ElementId neighbour : object.element(sponsor).neighbours) {
      waiting_list.push_front({neighbour, sponsor});
    }
  }
};

/// Spiral (thesis 3.2, first alteration): each neighbour is added to the back.
struct Spiral {
  template <class Scalar>
  static void add_neighbours(Object<Scalar>& object, ElementId sponsor, std::list<WaitingListData>& waiting_list) {
    for (const ElementId neighbour : object.element(sponsor).neighbours) {
      waiting_list.push_back({neighbour, sponsor});
    }
  }
};

/// Natural Queue ChainMail (thesis 4.1): each neighbour is added to the back, but only if its processing state is not
/// 'updated'.
struct NaturalQueueChainMail {
  template <class Scalar>
  static void add_neighbours(Object<Scalar>& object, ElementId sponsor, std::list<WaitingListData>& waiting_list) {
    for (const ElementId neighbour : object.element(sponsor).neighbours) {
      if (!object.element(neighbour).updated) {
        waiting_list.push_back({neighbour, sponsor});
      }
    }
  }
};

/// Moves an element into its valid region R about its sponsor. Returns true if its position changed.
template <class Scalar>
bool move_into_valid_region(Object<Scalar>& object, Element<Scalar>& element, ElementId sponsor) {
  const auto& about = object.element(sponsor).current_position;
  const auto& region = object.softness_of(sponsor, element.identifier);
  const auto before = element.current_position;
  for (int k = 0; k < object.space_dimension; ++k) {
    Scalar& x = element.current_position[k];
    x = std::min(std::max(x, about[k] + region.low[k]), about[k] + region.high[k]);
  }
  return element.current_position != before;
}

/// An element of the handle, and its target.
struct Held {
  ElementId element;
  std::array<double, 3> target;
};
/// The elements of the handle, in ascending order of their identifiers.
using Handle = std::vector<Held>;

/// Moves the elements of the handle to their targets.
template <class Scalar>
void begin(Object<Scalar>& object, const Handle& handle) {
  for (Element<Scalar>& element : object.elements) {
    element.updated = false;
  }
  for (const Held& one : handle) {
    Element<Scalar>& held = object.element(one.element);
    for (int k = 0; k < object.space_dimension; ++k) {
      held.current_position[k] = static_cast<Scalar>(one.target[k]);
    }
    held.updated = true;
  }
}

/// Updates a candidate that has not been updated. Returns true if it moved.
template <class Scalar>
bool update(Object<Scalar>& object, const WaitingListData& next, std::vector<Processed>& processed) {
  Element<Scalar>& element = object.element(next.element);
  const bool moved = move_into_valid_region(object, element, next.sponsor);
  element.updated = true;
  processed.push_back({next.element, next.sponsor, moved});
  return moved;
}

/// Runs one move with its pass. Returns the processed candidates in their order.
template <class Algorithm, class Scalar>
std::vector<Processed> move(Object<Scalar>& object, const Handle& handle) {
  std::vector<Processed> processed;
  begin(object, handle);
  std::list<WaitingListData> waiting_list;
  for (const Held& one : handle) {
    Algorithm::add_neighbours(object, one.element, waiting_list);
  }
  while (!waiting_list.empty()) {
    const WaitingListData next = waiting_list.front();
    waiting_list.pop_front();
    if (!object.element(next.element).updated && update(object, next, processed)) {
      Algorithm::add_neighbours(object, next.element, waiting_list);
    }
  }
  return processed;
}

}  // namespace reference

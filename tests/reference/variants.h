#pragma once

#include <stdexcept>

#include "reference/chainmail.h"

namespace reference {

/// Returns the distance of an element from its valid region about its sponsor, in rest lengths.
template <class Scalar>
double violation(Object<Scalar>& object, ElementId identifier, ElementId sponsor) {
  const Element<Scalar>& element = object.element(identifier);
  const Element<Scalar>& about = object.element(sponsor);
  const auto& region = object.softness_of(sponsor, identifier);
  double outside = 0, length = 0;
  for (int k = 0; k < object.space_dimension; ++k) {
    const Scalar low = about.current_position[k] + region.low[k], high = about.current_position[k] + region.high[k];
    const double x = element.current_position[k];
    const double excess = std::max({double(low) - x, x - double(high), 0.0});
    const double rest = element.original_position[k] - about.original_position[k];
    outside += excess * excess;
    length += rest * rest;
  }
  return std::sqrt(outside) / (length > 0 ? std::sqrt(length) : object.mesh().mean_link_length);
}

/// Enhanced ChainMail (Schill et al. 1998): the waiting candidate with the largest violation comes next; of equal ones,
/// the first. It searches the whole list.
template <class Scalar>
std::vector<Processed> move_enhanced(Object<Scalar>& object, const Handle& handle) {
  std::vector<Processed> processed;
  begin(object, handle);
  std::list<WaitingListData> waiting_list;
  for (const Held& one : handle) {
    NaturalQueueChainMail::add_neighbours(object, one.element, waiting_list);
  }
  while (!waiting_list.empty()) {
    auto most = waiting_list.begin();
    double largest = violation(object, most->element, most->sponsor);
    for (auto one = std::next(most); one != waiting_list.end(); ++one) {
      // An element that was updated in the meantime is dropped anyway, although it moved after its candidate was added.
      const double its = object.element(one->element).updated ? 0 : violation(object, one->element, one->sponsor);
      if (its > largest) {
        most = one;
        largest = its;
      }
    }
    const WaitingListData next = *most;
    waiting_list.erase(most);
    if (!object.element(next.element).updated && update(object, next, processed)) {
      NaturalQueueChainMail::add_neighbours(object, next.element, waiting_list);
    }
  }
  return processed;
}

/// 3D ChainMail (thesis 2.1): right, left, top, bottom, front, back.
enum Direction { right, left, top, bottom, front, back };

/// Returns the direction of a neighbour in a grid, from the lattice indices of both elements.
inline Direction direction_of(const chainmail::Lattice& lattice, ElementId from, ElementId to) {
  const auto difference = (lattice.position(to) - lattice.position(from)).eval();
  for (int k = 0; k < 3; ++k) {
    if (difference[k] != 0) {
      return static_cast<Direction>(2 * k + (difference[k] < 0 ? 1 : 0));
    }
  }
  throw std::logic_error("not a neighbour in a grid");
}

/// The lists to which an element of each list adds its neighbours, as in the figures of the paper.
inline const std::array<std::list<Direction>, 6> feeds{std::list<Direction>{right, top, bottom, front, back},
                                                       {left, top, bottom, front, back},
                                                       {top, front, back},
                                                       {bottom, front, back},
                                                       {front},
                                                       {back}};

template <class Scalar>
std::vector<Processed> move_3d_chainmail(Object<Scalar>& object, const Handle& handle) {
  std::vector<Processed> processed;
  begin(object, handle);
  std::array<std::list<WaitingListData>, 6> lists;
  const auto feed = [&](ElementId sponsor, const std::list<Direction>& into) {
    for (const ElementId neighbour : object.element(sponsor).neighbours) {
      const Direction direction = direction_of(*object.mesh().lattice, sponsor, neighbour);
      if (std::find(into.begin(), into.end(), direction) != into.end()) {
        lists[direction].push_back({neighbour, sponsor});
      }
    }
  };
  for (const Held& one : handle) {
    feed(one.element, {right, left, top, bottom, front, back});
  }
  for (const Direction direction : {right, left, top, bottom, front, back}) {
    auto& list = lists[direction];
    for (; !list.empty(); list.pop_front()) {
      const WaitingListData next = list.front();
      if (!object.element(next.element).updated && update(object, next, processed)) {
        feed(next.element, feeds[direction]);
      }
    }
  }
  return processed;
}

}  // namespace reference

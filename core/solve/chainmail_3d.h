#pragma once

#include <array>
#include <cstdlib>
#include <utility>

#include "solve/propagate.h"

namespace chainmail {

/// 3D ChainMail (Frisken-Gibson 1997; thesis 2.1), for rectangular meshes: one waiting list per direction.
///
/// The lists are worked through in the order right, left, top, bottom, front, back (+x, −x, +y, −y, +z, −z). A list
/// feeds itself and the lists of later axes; the grabbed element feeds all. First in, first out; all candidates are
/// admitted. Arguments and result as in propagate().
template <class List = BackList>
class DirectionLists {
 public:
  static constexpr int list_count = 6;

  DirectionLists() = default;
  explicit DirectionLists(std::array<List, list_count> lists) : lists_(std::move(lists)) {}

  template <class Body, class Record>
  void propagate(Body& body, Record& record, ElementId grabbed, std::vector<ElementId>& moved) {
    if (record.begin(body, grabbed, moved)) {
      return;
    }
    const Steps steps = steps_of(*body.mesh);
    body.begin_pass();
    body.mark_updated(grabbed);
    feed(body, steps, grabbed, all_lists);
    for (int list = 0; list < list_count; ++list) {
      while (!lists_[list].empty()) {
        const Candidate candidate = lists_[list].take();
        const ElementId element = body.mesh->neighbours[candidate.entry];
        if (body.updated(element)) {
          continue;
        }
        if (record.update(body, candidate, moved)) {
          feed(body, steps, element, list);
        }
      }
    }
    record.end();
  }

 private:
  static constexpr int all_lists = -1;

  /// Difference of the ids of neighbours along each axis; 0 if the lattice is one element thick.
  using Steps = std::array<std::int64_t, 3>;

  static Steps steps_of(const Mesh& mesh) {
    const auto& size = mesh.lattice->size;
    return {size[0] > 1 ? 1 : 0, size[1] > 1 ? size[0] : 0, size[2] > 1 ? std::int64_t{size[0]} * size[1] : 0};
  }

  /// Returns the list of a neighbour with this difference of ids.
  static int list_of(const Steps& steps, std::int64_t difference) {
    int axis = 0;
    while (steps[axis] != std::abs(difference)) {
      ++axis;
    }
    return 2 * axis + (difference < 0 ? 1 : 0);
  }

  template <class Body>
  void feed(const Body& body, const Steps& steps, ElementId sponsor, int from) {
    body.for_each_neighbour(sponsor, [&](ElementId neighbour, EntryId entry) {
      const int list = list_of(steps, std::int64_t{neighbour} - std::int64_t{sponsor});
      if (from == all_lists || list == from || list / 2 > from / 2) {
        lists_[list].admit({entry, sponsor});
      }
    });
  }

  std::array<List, list_count> lists_;
};

}  // namespace chainmail

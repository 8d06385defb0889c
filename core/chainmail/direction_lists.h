#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "chainmail/waiting_list.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The waiting list of 3D ChainMail (Frisken-Gibson 1997; thesis 2.1), for rectangular meshes: one list per direction.
///
/// Candidates are taken from the first list that is not empty, in the order right, left, top, bottom, front, back (+x,
/// −x, +y, −y, +z, −z). An element that was taken from a list feeds that list and those of later axes; the grabbed
/// element feeds all. Within a list: first in, first out. All candidates are admitted.
class DirectionLists : public PlainList {
 public:
  static constexpr bool admits_updated = true;
  static constexpr TakingOrder order = TakingOrder::by_key;

  /// Begins a pass: the grabbed element is the first sponsor.
  void begin(const Mesh& mesh) {
    mesh_ = &mesh;
    const auto& size = mesh.lattice->size;
    steps_ = {size[0] > 1 ? 1 : 0, size[1] > 1 ? size[0] : 0, size[2] > 1 ? std::int64_t{size[0]} * size[1] : 0};
    from_ = all_lists;
    first_ = 0;
  }

  bool admits(Candidate candidate) const {
    const int list = list_of(candidate);
    return from_ == all_lists || list == from_ || list / 2 > from_ / 2;
  }
  /// Candidates with the largest key are taken first.
  double key(Candidate candidate, double /*violation*/) const { return -list_of(candidate); }

  void admit(Candidate candidate, double /*violation*/) { lists_[std::size_t(list_of(candidate))].admit(candidate); }
  /// No list before the one in use is fed, so those stay empty.
  bool empty() {
    while (first_ < list_count && lists_[std::size_t(first_)].empty()) {
      ++first_;
    }
    return first_ == list_count;
  }
  Candidate take() {
    from_ = first_;
    return lists_[std::size_t(first_)].take();
  }

 private:
  static constexpr int list_count = 6;
  static constexpr int all_lists = -1;

  /// Returns the list of a candidate: its direction from its sponsor.
  int list_of(Candidate candidate) const {
    const std::int64_t difference = std::int64_t{mesh_->neighbours[candidate.entry]} - std::int64_t{candidate.sponsor};
    int axis = 0;
    while (steps_[std::size_t(axis)] != std::abs(difference)) {
      ++axis;
    }
    return 2 * axis + (difference < 0 ? 1 : 0);
  }

  const Mesh* mesh_ = nullptr;
  std::array<std::int64_t, 3> steps_{};  // differences of ids of neighbours along each axis; 0: one element thick
  int from_ = all_lists;                 // the list from which the present sponsor was taken
  int first_ = 0;
  std::array<BackList, list_count> lists_;
};

}  // namespace chainmail

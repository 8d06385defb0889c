#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "body/region.h"

namespace chainmail::bench {

/// Natural Queue ChainMail (Dean 2004, 4.1) as a textbook would write it: elements, neighbours and valid regions in
/// arrays, candidates in a first-in first-out queue, and a mark for each updated element. No data is kept from pass to
/// pass.
template <class Scalar, int Dimension>
class Textbook {
 public:
  Textbook(const MeshPointer& mesh, const LinkSoftness& softness) : mesh_(mesh), updated_(mesh->element_count()) {
    positions_.resize(mesh->element_count());
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      std::copy_n(mesh->rest.begin() + std::ptrdiff_t{e} * Dimension, Dimension, positions_[e].begin());
      for (const ElementId neighbour : mesh->neighbours_of(e)) {
        regions_.push_back(valid_region<Scalar, Dimension>(*mesh, e, neighbour, softness));
      }
    }
  }

  /// Returns how many elements moved, without the grabbed element.
  std::uint64_t move(ElementId grabbed, const Point& target) {
    ++pass_;
    queue_.clear();
    std::uint64_t moved = 0;
    for (int k = 0; k < Dimension; ++k) {
      positions_[grabbed][std::size_t(k)] = static_cast<Scalar>(target[mesh_->axes[std::size_t(k)]]);
    }
    updated_[grabbed] = pass_;
    admit_neighbours(grabbed);
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const Candidate next = queue_[i];
      if (updated_[next.element] != pass_) {
        updated_[next.element] = pass_;
        if (clamp(next)) {
          ++moved;
          admit_neighbours(next.element);
        }
      }
    }
    return moved;
  }

  const std::vector<std::array<Scalar, Dimension>>& positions() const { return positions_; }

 private:
  struct Candidate {
    ElementId element, sponsor;
    EntryId entry;
  };

  void admit_neighbours(ElementId sponsor) {
    for (EntryId entry = mesh_->first_entry[sponsor]; entry < mesh_->first_entry[sponsor + 1]; ++entry) {
      if (updated_[mesh_->neighbours[entry]] != pass_) {
        queue_.push_back({mesh_->neighbours[entry], sponsor, entry});
      }
    }
  }

  bool clamp(const Candidate& one) {
    auto& position = positions_[one.element];
    const auto before = position;
    const auto& about = positions_[one.sponsor];
    const auto& region = regions_[one.entry];
    for (std::size_t k = 0; k < Dimension; ++k) {
      position[k] = std::min(std::max(position[k], about[k] + region.low[k]), about[k] + region.high[k]);
    }
    return position != before;
  }

  MeshPointer mesh_;
  std::vector<std::array<Scalar, Dimension>> positions_;
  std::vector<Region<Scalar, Dimension>> regions_;  // for each entry of the neighbour table
  std::vector<std::uint32_t> updated_;              // the last pass that updated the element
  std::vector<Candidate> queue_;
  std::uint32_t pass_ = 0;
};

}  // namespace chainmail::bench

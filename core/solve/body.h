#pragma once

#include <cstdint>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/region.h"
#include "solve/softness.h"

namespace chainmail {

/// What a pass reads and writes of one element. Bytes: 8, 12, 16 in float, 16, 24, 32 in double for
/// one, two and three dimensions.
template <class Scalar, int Dimension>
struct ElementState {
  Scalar position[Dimension];  // absolute, mesh units
  std::uint32_t updated;       // the last pass in which the element counted as updated
};

/// An object as the algorithms of one scalar and one space dimension see it.
template <class Scalar_, int Dimension_>
struct Body {
  using Scalar = Scalar_;
  static constexpr int Dimension = Dimension_;

  explicit Body(MeshPointer of) : mesh(std::move(of)), cuts(mesh), elements(mesh->element_count()) {
    reset_positions();
    set_softness({});
  }

  void reset_positions() {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        elements[e].position[k] = static_cast<Scalar>(mesh->rest[e * Dimension + k]);
      }
    }
  }

  void set_softness(const Softness& softness) {
    regions.resize(mesh->neighbours.size());
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      for (EntryId entry = mesh->first_entry[e]; entry < mesh->first_entry[e + 1]; ++entry) {
        regions[entry] =
            valid_region<Scalar, Dimension>(*mesh, e, mesh->neighbours[entry], softness.of(mesh->entry_link[entry]));
      }
    }
  }

  /// Begins a pass: no element counts as updated any more.
  void begin_pass() {
    if (++pass == 0) {  // after 2³² passes
      for (auto& element : elements) {
        element.updated = 0;
      }
      pass = 1;
    }
  }
  bool updated(ElementId element) const { return elements[element].updated == pass; }
  void mark_updated(ElementId element) { elements[element].updated = pass; }

  /// Clamps the candidate's element into its valid region about its sponsor; says whether it moved.
  bool clamp(ElementId element, ElementId sponsor, EntryId entry) {
    Scalar* x = elements[element].position;
    const Scalar* about = elements[sponsor].position;
    const auto& region = regions[entry];
    bool moved = false;
    for (int k = 0; k < Dimension; ++k) {
      const Scalar low = about[k] + region.low[k];
      const Scalar high = about[k] + region.high[k];
      Scalar clamped = x[k] < low ? low : x[k];
      clamped = high < clamped ? high : clamped;
      moved |= clamped != x[k];
      x[k] = clamped;
    }
    return moved;
  }

  /// Calls visit(neighbour, entry) for each neighbour to which the link is not cut, in the file's order.
  template <class Visit>
  void for_each_neighbour(ElementId element, Visit visit) const {
    const bool has_cuts = cuts.touches(element);
    for (EntryId entry = mesh->first_entry[element]; entry < mesh->first_entry[element + 1]; ++entry) {
      if (!has_cuts || !cuts.is_cut(mesh->entry_link[entry])) {
        visit(mesh->neighbours[entry], entry);
      }
    }
  }

  MeshPointer mesh;
  Cuts cuts;
  std::vector<ElementState<Scalar, Dimension>> elements;
  std::vector<Region<Scalar, Dimension>> regions;  // one an entry of the neighbour table
  std::uint32_t pass = 0;
};

}  // namespace chainmail

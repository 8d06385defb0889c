#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/region_table.h"
#include "solve/softness.h"

namespace chainmail {

/// Where an element stands (mesh units). In space it is padded, so that all axes move at once. Bytes: 4, 8, 16
/// in float, 8, 16, 32 in double for one, two and three dimensions.
template <class Scalar, int Dimension>
struct Place {
  static constexpr int lanes = Dimension == 3 ? 4 : Dimension;

  Scalar& operator[](int k) { return at[k]; }
  const Scalar& operator[](int k) const { return at[k]; }
  bool operator==(const Place& other) const {
    bool equal = true;
    for (int k = 0; k < Dimension; ++k) {
      equal &= at[k] == other.at[k];
    }
    return equal;
  }

  alignas(lanes * sizeof(Scalar)) Scalar at[lanes];
};

/// A place clamped into a region whose lower bounds count from `low`, and upper ones from `high` (mesh units).
template <class Scalar, int Dimension>
Place<Scalar, Dimension> clamped(Place<Scalar, Dimension> place, const Scalar* low, const Scalar* high,
                                 const Region<Scalar, Dimension>& region) {
  for (int k = 0; k < Dimension; ++k) {
    const Scalar lowest = low[k] + region.low[k];
    const Scalar highest = high[k] + region.high[k];
    place[k] = place[k] < lowest ? lowest : place[k];
    place[k] = highest < place[k] ? highest : place[k];
  }
  return place;
}

/// How far an element at `x` lies outside its valid region about its sponsor at `about`, in rest lengths. In
/// double, like the metric; what a mesh without a mean length divides by makes no order.
template <class Scalar, int Dimension>
double candidate_violation(const Mesh& mesh, ElementId element, const Scalar* x, ElementId sponsor, const Scalar* about,
                           const Region<Scalar, Dimension>& region) {
  double outside = 0, length = 0;
  for (int k = 0; k < Dimension; ++k) {
    const Scalar low = about[k] + region.low[k];
    const Scalar high = about[k] + region.high[k];
    const double excess = x[k] < low ? double(low) - double(x[k]) : high < x[k] ? double(x[k]) - double(high) : 0;
    const double rest =
        mesh.rest[std::size_t{element} * Dimension + k] - mesh.rest[std::size_t{sponsor} * Dimension + k];
    outside += excess * excess;
    length += rest * rest;
  }
  if (outside == 0) {
    return 0;
  }
  return std::sqrt(outside) / (length > 0 ? std::sqrt(length) : mesh.mean_link_length > 0 ? mesh.mean_link_length : 1);
}

/// An object as the algorithms of one scalar and one space dimension see it.
template <class Scalar_, int Dimension_>
struct Body {
  using Scalar = Scalar_;
  static constexpr int Dimension = Dimension_;

  explicit Body(MeshPointer of, bool held_from_rest = false)
      : mesh(std::move(of)),
        cuts(mesh),
        places(mesh->element_count()),
        updates(mesh->element_count()),
        from_rest(held_from_rest) {
    reset_positions();
    set_softness({});
  }

  /// What the held positions of an element are measured from, on axis k (mesh units).
  double origin(ElementId element, int k) const {
    return from_rest ? mesh->rest[std::size_t{element} * Dimension + k] : 0;
  }
  double absolute(ElementId element, int k) const {
    const double held = double(places[element][k]);
    return from_rest ? origin(element, k) + held : held;  // 0 + −0 would be 0
  }
  void place(ElementId element, int k, double absolute_position) {
    places[element][k] = static_cast<Scalar>(absolute_position - origin(element, k));
  }

  void reset_positions() {
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        place(e, k, mesh->rest[std::size_t{e} * Dimension + k]);
      }
    }
  }

  void set_softness(const Softness& softness) { regions.set(*mesh, softness, from_rest); }

  /// Holds positions as displacements from rest and regions about rest vectors, or both absolute.
  void hold_from_rest(bool displacements, const Softness& softness) {
    if (displacements == from_rest) {
      return;
    }
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        const double rest = mesh->rest[std::size_t{e} * Dimension + k];
        Scalar& x = places[e][k];
        x = static_cast<Scalar>(displacements ? double(x) - rest : double(x) + rest);
      }
    }
    from_rest = displacements;
    set_softness(softness);
  }

  /// Begins a pass: no element but the pinned ones counts as updated any more.
  void begin_pass() {
    if (++pass == always) {
      for (auto& update : updates) {
        update = update == always ? always : 0;
      }
      pass = 1;
    }
  }
  bool updated(ElementId element) const { return updates[element] >= pass; }
  void mark_updated(ElementId element) { updates[element] = pass; }

  bool pinned(ElementId element) const { return updates[element] == always; }
  void set_pinned(ElementId element, bool is_pinned) {
    pin_count += is_pinned ? 1 : 0;
    pin_count -= pinned(element) ? 1 : 0;
    updates[element] = is_pinned ? always : 0;
  }

  /// The place of an element clamped into its valid region about its sponsor.
  Place<Scalar, Dimension> clamped(ElementId element, ElementId sponsor, std::uint32_t region_id) const {
    const Scalar* about = places[sponsor].at;
    return chainmail::clamped(places[element], about, about, regions.at(region_id));
  }

  /// Clamps the candidate's element into its valid region about its sponsor; says whether it moved.
  bool clamp(ElementId element, ElementId sponsor, EntryId entry) {
    const auto place = clamped(element, sponsor, regions.id(entry));
    const bool moved = place != places[element];
    places[element] = place;
    return moved;
  }

  /// How far the candidate's element lies outside its valid region about its sponsor, in rest lengths.
  double violation(ElementId element, ElementId sponsor, EntryId entry) const {
    return candidate_violation(*mesh, element, places[element].at, sponsor, places[sponsor].at, regions[entry]);
  }

  /// Calls visit(neighbour, entry) for each neighbour to which the link is not cut, in the file's order.
  template <class Visit>
  [[gnu::always_inline]] void for_each_neighbour(ElementId element, Visit visit) const {
    chainmail::for_each_neighbour(*mesh, cuts, element, visit);
  }

  static constexpr std::uint32_t always = std::numeric_limits<std::uint32_t>::max();

  MeshPointer mesh;
  Cuts cuts;
  std::vector<Place<Scalar, Dimension>> places;
  std::vector<std::uint32_t> updates;  // the last pass in which an element counted as updated; pinned: always
  RegionTable<Scalar, Dimension> regions;
  std::uint32_t pass = 1;
  ElementId pin_count = 0;
  bool from_rest = false;
};

}  // namespace chainmail

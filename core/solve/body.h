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

/// Position of an element (mesh units). In 3D it is padded, so that all axes are computed at once. Size in bytes for
/// one, two and three dimensions: 4, 8, 16 in float; 8, 16, 32 in double.
template <class Scalar, int Dimension>
struct Position {
  static constexpr int lanes = Dimension == 3 ? 4 : Dimension;

  Scalar& operator[](int k) { return at[k]; }
  const Scalar& operator[](int k) const { return at[k]; }
  bool operator==(const Position& other) const {
    bool equal = true;
    for (int k = 0; k < Dimension; ++k) {
      equal &= at[k] == other.at[k];
    }
    return equal;
  }

  alignas(lanes * sizeof(Scalar)) Scalar at[lanes];
};

/// Returns a position clamped into a region whose lower bounds are relative to `low`, and upper bounds to `high` (mesh
/// units).
template <class Scalar, int Dimension>
Position<Scalar, Dimension> clamped(const Position<Scalar, Dimension>& position, const Scalar* low, const Scalar* high,
                                    const Region<Scalar, Dimension>& region) {
  Position<Scalar, Dimension> result = position;
  for (int k = 0; k < Dimension; ++k) {
    const Scalar lowest = low[k] + region.low[k];
    const Scalar highest = high[k] + region.high[k];
    result[k] = result[k] < lowest ? lowest : result[k];
    result[k] = highest < result[k] ? highest : result[k];
  }
  return result;
}

/// Returns the distance of an element at `x` from its valid region about its sponsor at `about`, in rest lengths.
/// Computed in double, like the metric. For a mesh without a mean link length the divisor does not affect the order.
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

/// The state of one object, for one scalar and one space dimension.
template <class Scalar_, int Dimension_>
struct Body {
  using Scalar = Scalar_;
  static constexpr int Dimension = Dimension_;

  explicit Body(MeshPointer of, bool held_from_rest = false)
      : mesh(std::move(of)),
        cuts(mesh),
        positions(mesh->element_count()),
        updates(mesh->element_count()),
        from_rest(held_from_rest) {
    reset_positions();
    set_softness({});
  }

  /// The origin of the stored position of an element, on axis k (mesh units).
  double origin(ElementId element, int k) const {
    return from_rest ? mesh->rest[std::size_t{element} * Dimension + k] : 0;
  }
  double absolute(ElementId element, int k) const {
    const double held = double(positions[element][k]);
    return from_rest ? origin(element, k) + held : held;  // 0 + −0 would be 0
  }
  void set_position(ElementId element, int k, double absolute_position) {
    positions[element][k] = static_cast<Scalar>(absolute_position - origin(element, k));
  }

  void reset_positions() {
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        set_position(e, k, mesh->rest[std::size_t{e} * Dimension + k]);
      }
    }
  }

  void set_softness(const Softness& softness) { regions.set(*mesh, softness, from_rest); }

  /// Stores positions as displacements from rest, and regions about rest vectors; or both absolute.
  void hold_from_rest(bool displacements, const Softness& softness) {
    if (displacements == from_rest) {
      return;
    }
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      for (int k = 0; k < Dimension; ++k) {
        const double rest = mesh->rest[std::size_t{e} * Dimension + k];
        Scalar& x = positions[e][k];
        x = static_cast<Scalar>(displacements ? double(x) - rest : double(x) + rest);
      }
    }
    from_rest = displacements;
    set_softness(softness);
  }

  /// Begins a pass: only pinned elements count as updated.
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

  /// Returns the position of an element clamped into its valid region about its sponsor.
  Position<Scalar, Dimension> clamped(ElementId element, ElementId sponsor, std::uint32_t region_id) const {
    const Scalar* about = positions[sponsor].at;
    return chainmail::clamped(positions[element], about, about, regions.at(region_id));
  }

  /// Clamps the candidate's element into its valid region about its sponsor. Returns true if it moved.
  bool clamp(ElementId element, ElementId sponsor, EntryId entry) {
    const auto position = clamped(element, sponsor, regions.id(entry));
    const bool moved = position != positions[element];
    positions[element] = position;
    return moved;
  }

  /// Returns the distance of the candidate's element from its valid region about its sponsor, in rest lengths.
  double violation(ElementId element, ElementId sponsor, EntryId entry) const {
    return candidate_violation(*mesh, element, positions[element].at, sponsor, positions[sponsor].at, regions[entry]);
  }

  /// Calls visit(neighbour, entry) for each neighbour whose link is not cut, in the file's order.
  template <class Visit>
  [[gnu::always_inline]] void for_each_neighbour(ElementId element, Visit visit) const {
    chainmail::for_each_neighbour(*mesh, cuts, element, visit);
  }

  static constexpr std::uint32_t always = std::numeric_limits<std::uint32_t>::max();

  MeshPointer mesh;
  Cuts cuts;
  std::vector<Position<Scalar, Dimension>> positions;
  std::vector<std::uint32_t> updates;  // the last pass in which an element counted as updated; pinned: always
  RegionTable<Scalar, Dimension> regions;
  std::uint32_t pass = 1;
  ElementId pin_count = 0;
  bool from_rest = false;
};

}  // namespace chainmail

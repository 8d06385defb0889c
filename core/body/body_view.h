#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "body/handle.h"
#include "mesh/error.h"

namespace chainmail {

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

/// The links of a body, and what a pass has updated: access for loops that read no position. It is a handful of
/// pointers: made for a pass, not kept.
class BodyLinks {
 private:
  struct Row {
    const std::uint32_t* offset;  // of the ids of neighbours, to be added to the base
    std::uint32_t base, size;
    const std::uint16_t* shape;  // the ids of the regions; without it they are consecutive
    std::uint32_t first;
  };

 public:
  const Revisions& revisions() const { return body_->revisions(); }
  std::size_t element_count() const { return updates.size(); }

  /// Begins a pass: only pinned elements count as updated.
  void begin_pass() { pass = body_->begin_pass(); }
  bool updated(ElementId element) const { return updates[element] >= pass; }
  void mark_updated(ElementId element) const { updates[element] = pass; }
  bool pinned(ElementId element) const { return updates[element] == Body::always; }

  /// Calls visit(neighbour, entry) for each neighbour whose link is not cut, in the file's order.
  template <class Visit>
  [[gnu::always_inline]] void for_each_neighbour(ElementId element, Visit visit) const {
    chainmail::for_each_neighbour(*mesh, cuts, element, visit);
  }

  /// Calls visit(neighbour, region) for each neighbour whose link is not cut, in the file's order, with the id of the
  /// region of the link. Reads no row where the mesh has kinds of rows.
  template <class Visit>
  [[gnu::always_inline]] void for_each_link(ElementId element, Visit visit) const {
    const Links links = this->links(element);
    for (std::uint32_t i = 0; i < links.size(); ++i) {
      if (!links.is_cut(i)) {
        const auto [neighbour, region] = links[i];
        visit(neighbour, region);
      }
    }
  }

  /// The links of an element in the file's order, with those that are cut.
  class Links {
   public:
    struct Link {
      ElementId neighbour;
      std::uint32_t region;
    };
    std::uint32_t size() const { return row_.size; }
    [[gnu::always_inline]] Link operator[](std::uint32_t i) const {
      return {row_.base + row_.offset[i], row_.shape != nullptr ? row_.shape[i] : row_.first + i};
    }
    [[gnu::always_inline]] bool is_cut(std::uint32_t i) const { return ids_ != nullptr && cuts_->is_cut(ids_[i]); }

   private:
    friend class BodyLinks;
    Links(const Row& row, const LinkId* ids, const Cuts& cuts) : row_(row), ids_(ids), cuts_(&cuts) {}

    Row row_;
    const LinkId* ids_;  // null if no link of the element is cut
    const Cuts* cuts_;
  };
  [[gnu::always_inline]] Links links(ElementId element) const {
    const LinkId* ids = cuts.touches(element) ? mesh->entry_link.data() + mesh->first_entry[element] : nullptr;
    return {row_of(element), ids, cuts};
  }
  /// The id of the region of a link.
  std::uint32_t region_id(EntryId entry) const { return has_shapes ? mesh->entry_shape[entry] : entry; }

  const Mesh* mesh;
  const Cuts& cuts;
  std::span<std::uint32_t> updates;  // the last pass in which an element counted as updated
  ElementId pin_count;
  std::uint32_t pass;
  bool has_shapes;  // the id of a region is the number of the rest vector of its link

 protected:
  BodyLinks(Body& body, bool by_shape)
      : mesh(body.stored_mesh_.get()),
        cuts(body.cuts_),
        updates(body.updates_),
        pin_count(static_cast<ElementId>(body.pins_.size())),
        pass(body.pass_),
        has_shapes(by_shape),
        body_(&body) {}

 private:
  [[gnu::always_inline]] Row row_of(ElementId element) const {
    const RowKinds& kinds = mesh->row_kinds;
    if (kinds.known()) {
      const std::uint32_t kind = kinds.of[element], at = kinds.first[kind];
      return {kinds.offset.data() + at, element, kinds.first[kind + 1] - at,
              has_shapes ? kinds.shape.data() + at : nullptr, has_shapes ? 0 : mesh->first_entry[element]};
    }
    const EntryId at = mesh->first_entry[element];
    return {mesh->neighbours.data() + at, 0, mesh->first_entry[element + 1] - at,
            has_shapes ? mesh->entry_shape.data() + at : nullptr, at};
  }

  Body* body_;
};

/// Typed access to a body for the loops of a pass, for one scalar and one space dimension. All coordinates are those of
/// the body's axes.
template <class Scalar_, int Dimension_>
class BodyView : public BodyLinks {
 public:
  using Scalar = Scalar_;
  static constexpr int Dimension = Dimension_;

  explicit BodyView(Body& body) : BodyView(body, std::get<Body::Typed<Scalar, Dimension>>(body.typed_)) {}

  /// The origin of the stored position of an element, on axis k (mesh units).
  double origin(ElementId element, int k) const {
    return from_rest ? mesh->rest[std::size_t{element} * Dimension + k] : 0;
  }
  double absolute(ElementId element, int k) const {
    const double held = double(positions[element][k]);
    return from_rest ? origin(element, k) + held : held;  // 0 + −0 would be 0
  }
  void set_position(ElementId element, int k, double absolute_position) const {
    positions[element][k] = static_cast<Scalar>(absolute_position - origin(element, k));
  }

  /// Returns the position of an element clamped into its valid region about its sponsor.
  Position<Scalar, Dimension> clamped(ElementId element, ElementId sponsor, std::uint32_t region_id) const {
    const Scalar* about = positions[sponsor].at;
    return chainmail::clamped(positions[element], about, about, regions.at(region_id));
  }

  /// Clamps the candidate's element into its valid region about its sponsor. Returns true if it moved.
  bool clamp(ElementId element, ElementId sponsor, EntryId entry) const {
    const auto position = clamped(element, sponsor, regions.id(entry));
    const bool moved = position != positions[element];
    positions[element] = position;
    return moved;
  }

  /// Returns the distance of the candidate's element from its valid region about its sponsor, in rest lengths.
  double violation(ElementId element, ElementId sponsor, EntryId entry) const {
    return candidate_violation(*mesh, element, positions[element].at, sponsor, positions[sponsor].at, regions[entry]);
  }

  std::span<Position<Scalar, Dimension>> positions;
  const RegionTable<Scalar, Dimension>& regions;
  bool from_rest;  // displacements from rest are stored, not positions

 private:
  BodyView(Body& body, Body::Typed<Scalar, Dimension>& typed)
      : BodyLinks(body, typed.regions.by_shape()),
        positions(typed.positions),
        regions(typed.regions),
        from_rest(body.stores_displacements_) {}
};

template <class Scalar, int Dimension>
BodyView<Scalar, Dimension> Body::view() {
  return BodyView<Scalar, Dimension>(*this);
}

template <class Use>
decltype(auto) Body::with_view(Use use) {
  return std::visit([&]<class T>(T&) -> decltype(auto) { return use(view<typename T::Scalar, T::Dimension>()); },
                    typed_);
}

/// Returns the stored coordinates of a target for an element (mesh units). Throws Error if one is not a finite number
/// of the scalar.
template <class Scalar, int Dimension>
Position<Scalar, Dimension> stored_target(const BodyView<Scalar, Dimension>& body, ElementId element,
                                          const Point& target) {
  static const Scalar limit = static_cast<Scalar>(
      position_limit(sizeof(Scalar) == sizeof(float) ? Precision::single_precision : Precision::double_precision));
  Position<Scalar, Dimension> next = body.positions[element];
  for (int k = 0; k < Dimension; ++k) {
    const double to = target[body.mesh->axes[std::size_t(k)]];
    // A move to the position that was read must not move the element, even after rounding.
    const bool stays = body.from_rest && to == body.absolute(element, k);
    next[k] = stays ? next[k] : static_cast<Scalar>(to - body.origin(element, k));
    if (!(std::abs(next[k]) <= limit)) {
      throw Error("element " + std::to_string(element), "its target is out of the range of the precision",
                  "use smaller coordinates, or compute in double");
    }
  }
  return next;
}

/// Calls use(element, target) for each element of a handle, with its target in stored coordinates (mesh units). Throws
/// Error if one is not a finite number of the scalar.
template <class Scalar, int Dimension, class Use>
void for_each_target(const BodyView<Scalar, Dimension>& body, const HandleMove& move, Use use) {
  const auto elements = move.handle.elements();
  if (move.handle.has_one()) {
    use(elements[0], stored_target(body, elements[0], move.pose.pivot));
    return;
  }
  const RigidMotion motion = move.handle.motion(move.pose);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    use(elements[i], stored_target(body, elements[i], move.handle.target(i, motion)));
  }
}

/// Moves the elements of a handle to their targets. Throws Error as for_each_target does; nothing has moved then.
template <class Scalar, int Dimension>
void place_handle(const BodyView<Scalar, Dimension>& body, const HandleMove& move) {
  if (!move.handle.has_one()) {
    for_each_target(body, move, [](ElementId, const auto&) {});
  }
  for_each_target(body, move, [&](ElementId element, const auto& target) { body.positions[element] = target; });
}

}  // namespace chainmail

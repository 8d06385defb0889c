#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "body/positions.h"
#include "body/region.h"
#include "body/region_axes.h"
#include "body/snapshot.h"
#include "body/softness.h"
#include "elastic/material.h"
#include "mesh/cuts.h"
#include "mesh/element_blocks.h"
#include "mesh/large_pages.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Numbers that grow when a part of a body changes. A method that keeps something for its next move also keeps the
/// revisions of the parts that it depends on, and compares them with the body's when it uses it.
struct Revisions {
  std::uint64_t cuts = 0;       // links were cut or restored
  std::uint64_t restored = 0;   // cut links were restored
  std::uint64_t softness = 0;   // the valid region of a link changed: its compression, stretch or shear
  std::uint64_t energy = 0;     // the kind of energy changed, or the energy of a link: its stiffness
  std::uint64_t pins = 0;       // elements were pinned or unpinned
  std::uint64_t elastic = 0;    // options of elasticity changed
  std::uint64_t positions = 0;  // positions were set, other than by a move or by relaxation
  std::uint64_t relaxed = 0;    // relaxation moved elements

  /// Returns the revisions of some parts only: the others are 0.
  Revisions only(std::initializer_list<std::uint64_t Revisions::*> parts) const {
    Revisions result;
    for (const auto part : parts) {
      result.*part = this->*part;
    }
    return result;
  }

  bool operator==(const Revisions&) const = default;
};

class BodyLinks;
template <class Scalar, int Dimension>
class BodyView;

/// The state of one object: mesh, positions, cuts, pins and softness. Each part that can change has a revision.
///
/// Positions are in one precision and as many axes as the space has. They may be stored along turned axes:
/// views give access to these, everything else speaks of the world. Bulk functions work on any body; a method that
/// needs typed access asks for a view.
class Body {
 public:
  Body(MeshPointer mesh, Precision precision);

  const Mesh& mesh() const { return *mesh_; }
  const MeshPointer& mesh_pointer() const { return mesh_; }
  Precision precision() const { return precision_; }
  const Revisions& revisions() const { return revisions_; }

  const Cuts& cuts() const { return cuts_; }
  void cut(std::span<const LinkId> links);
  void uncut(std::span<const LinkId> links);

  /// The pinned elements, ascending. They stay where they are when they are pinned; to move one is an error.
  std::span<const ElementId> pins() const { return pins_; }
  bool is_pinned(ElementId element) const { return updates_[element] == always; }
  void pin(std::span<const ElementId> elements);
  void unpin(std::span<const ElementId> elements);

  const Softness& softness() const { return *softness_; }
  const std::shared_ptr<const Softness>& shared_softness() const { return softness_; }
  /// Sets the softness. If memory runs out, the old one stays.
  void set_softness(std::shared_ptr<const Softness> softness);
  void set_softness(const Softness& softness) { set_softness(std::make_shared<const Softness>(softness)); }

  /// Returns the object without its positions.
  ObjectState object() const { return {mesh_, cuts_.links(), pins_, softness_}; }
  /// Restores cuts, pins and softness of an object of this mesh. What stays the same gets no new revision.
  void restore(const ObjectState& object);

  /// Options of the methods of elasticity. The ChainMail family ignores them.
  const ElasticOptions& elastic() const { return elastic_; }
  void set_elastic(const ElasticOptions& options);

  PositionView positions() const;

  /// The axes whose coordinates are stored: those of the softness, or those of the world while the body does not work
  /// in them.
  const RegionAxes& region_axes() const { return region_axes_; }
  /// The mesh with its rest positions in these coordinates: mesh() itself if nothing is turned. The views of methods
  /// have it, and so do the valid regions.
  const MeshPointer& stored_mesh() const { return stored_mesh_; }
  /// The positions in these coordinates.
  PositionView stored_positions() const;
  /// Works along the axes of the softness, as the ChainMail family does, or along the axes of the world. This rounds if
  /// the axes are turned, except at rest.
  void work_in_axes(bool works);
  bool works_in_axes() const { return works_in_axes_; }

  /// Writes the coordinates of the elements from `first` on into `out`, space_dimension per element (mesh units).
  void copy_positions(ElementId first, std::span<float> out) const;
  void copy_positions(ElementId first, std::span<double> out) const;
  /// Writes the coordinates of all elements.
  void copy_positions(std::span<float> out) const { copy_positions(0, out); }
  void copy_positions(std::span<double> out) const { copy_positions(0, out); }
  /// Sets all coordinates, in the order of copy_positions.
  void set_positions(std::span<const double> in);

  /// True if all elements are known to be at rest.
  bool is_at_rest() const { return is_at_rest_; }
  /// Call this after a move.
  void note_move() { is_at_rest_ = false; }
  /// Call this after relaxation moved elements.
  void note_relaxation() {
    is_at_rest_ = false;
    ++revisions_.relaxed;
  }
  /// Moves all elements to rest. Cuts, pins and softness stay.
  void reset();
  /// The same as reset(), but faster. No element outside these blocks may be away from rest.
  void reset(const ElementBlocks& away);

  /// Returns the positions.
  Snapshot snapshot() const;
  /// Restores all positions of a snapshot of this mesh and precision.
  void restore(const Snapshot& snapshot);
  /// The same as snapshot(), but faster. No element outside `away` may be away from rest.
  Snapshot snapshot(const ElementBlocks& away) const;
  /// Updates these blocks of a snapshot of this body. No element outside `away` may be away from rest.
  void update(Snapshot& snapshot, const ElementBlocks& blocks, const ElementBlocks& away) const;
  /// Restores these blocks of a snapshot that passed check(). All others must be as in the snapshot.
  void restore(const Snapshot& snapshot, const ElementBlocks& blocks);

  /// True if displacements from rest are stored, which keep their digits however far the object is from the origin;
  /// false if positions are stored.
  bool stores_displacements() const { return stores_displacements_; }
  /// Stores displacements, or positions. This rounds, except at rest.
  void store_displacements(bool displacements);

  /// Largest moves (mesh units): Exact ChainMail derives from them how far rounding may have moved the links. They
  /// outlive a change of method.
  struct Reach {
    double since_rest = 0;   // the largest displacement or move since the object was at rest
    double since_check = 0;  // the largest one since the links were last checked
  };
  Reach& reach() { return reach_; }

  /// Returns typed access. Scalar and Dimension must be those of precision() and of the mesh. The view is valid until
  /// the body is changed by something else.
  template <class Scalar, int Dimension>
  BodyView<Scalar, Dimension> view();

  /// Calls use(view) with the view of this body's own type, and returns its result.
  template <class Use>
  decltype(auto) with_view(Use use);

 private:
  friend class BodyLinks;
  template <class Scalar, int Dimension>
  friend class BodyView;

  template <class Scalar_, int Dimension_>
  struct Typed {
    using Scalar = Scalar_;
    static constexpr int Dimension = Dimension_;
    LargeVector<Position<Scalar, Dimension>> positions;
    RegionTable<Scalar, Dimension> regions;
  };
  using AnyTyped = std::variant<Typed<float, 1>, Typed<float, 2>, Typed<float, 3>, Typed<double, 1>, Typed<double, 2>,
                                Typed<double, 3>>;

  static constexpr std::uint32_t always = std::numeric_limits<std::uint32_t>::max();

  static AnyTyped make_typed(Precision precision, int dimension);
  std::uint32_t begin_pass();
  void set_pins(std::vector<ElementId> pins);
  template <class Out>
  void copy(ElementId first, std::span<Out> out) const;
  /// Call this after positions were set.
  void note_positions_set(bool at_rest);
  PositionView view_of_stored(const Mesh& from_rest, const AxisTurn* turn) const;
  const AxisTurn* turn() const { return region_axes_.is_turned() ? &turn_ : nullptr; }
  /// Stores the positions in the coordinates of some axes, with the regions of a softness along them.
  void store_in(const RegionAxes& axes, const Softness& softness);

  MeshPointer mesh_;
  MeshPointer stored_mesh_;
  RegionAxes region_axes_;
  AxisTurn turn_;  // from the axes into the world
  bool works_in_axes_ = true;
  Precision precision_;
  Cuts cuts_;
  std::vector<ElementId> pins_;  // ascending
  std::shared_ptr<const Softness> softness_;
  ElasticOptions elastic_;
  AnyTyped typed_;
  LargeVector<std::uint32_t> updates_;  // the last pass in which an element counted as updated; pinned: always
  std::uint32_t pass_ = 1;
  bool stores_displacements_ = false;
  bool is_at_rest_ = true;
  Reach reach_;
  Revisions revisions_;
};

}  // namespace chainmail

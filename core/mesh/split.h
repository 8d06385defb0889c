#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Two elements in one number, in any order: the key of the edge of a face.
using EdgeKey = std::uint64_t;

constexpr EdgeKey edge_key(ElementId a, ElementId b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }
/// Returns the two elements, the lower one first.
constexpr std::array<ElementId, 2> ends_of(EdgeKey key) {
  return {static_cast<ElementId>(key >> 32), static_cast<ElementId>(key)};
}

/// An element that a split appends: a point on the line between two elements, or inside the triangle of three. They
/// come before it in the order of ids.
struct SplitPoint {
  /// Its rest position is p0 + shares[0] · (p1 − p0) + shares[1] · (p2 − p0). A copy has three equal elements.
  std::array<ElementId, 3> of{};
  std::array<double, 2> shares{};

  static SplitPoint copy(ElementId element) { return {{element, element, element}, {0, 0}}; }
  static SplitPoint between(ElementId from, ElementId to, double share) { return {{from, to, from}, {share, 0}}; }
  bool is_copy() const { return of[1] == of[0] && of[2] == of[0]; }
  /// Returns the value at the point of anything that is known at its elements and linear between them.
  template <class Value>
  Value mix(const Value& first, const Value& second, const Value& third) const {
    return first + shares[0] * (second - first) + shares[1] * (third - first);
  }

  bool operator==(const SplitPoint&) const = default;
};

/// What a cut along a stroke changes in a mesh: it appends elements, and replaces faces and cells.
struct SplitEdit {
  std::vector<SplitPoint> elements;                 // appended
  std::vector<std::uint32_t> removed;               // triangles that go, ascending: indices below Mesh::own_triangles
  std::vector<std::array<ElementId, 3>> triangles;  // appended
  std::vector<std::uint32_t> removed_polygons;      // the same for polygons, which are counted from 0
  std::vector<ElementId> polygons;                  // appended: count, corner…, count, corner…
  std::vector<std::uint32_t> removed_cells{};       // cells that go, ascending: see CellId
  std::vector<std::array<ElementId, 4>> tetrahedra{};  // appended
  std::vector<std::array<ElementId, 8>> hexahedra{};   // appended

  bool empty() const {
    return elements.empty() && removed.empty() && removed_polygons.empty() && removed_cells.empty();
  }
  bool operator==(const SplitEdit&) const = default;
};

class Split;
using SplitPointer = std::shared_ptr<const Split>;

/// A mesh, held as what makes it: the mesh before all splits, and the splits. So it takes memory in proportion to what
/// they change.
class MeshSource {
 public:
  explicit MeshSource(const MeshPointer& mesh);

  /// Returns the mesh: the same one as long as somebody keeps it. Otherwise it is made again, which takes time in
  /// proportion to its size for each split after a mesh that somebody keeps. Safe to call from several threads.
  MeshPointer mesh() const;

 private:
  friend class Split;

  explicit MeshSource(SplitPointer split) : split_(std::move(split)) {}

  MeshPointer first_;   // null after splits
  SplitPointer split_;  // null before the first one
};

/// A change of a mesh by an edit. The elements keep their ids. The links are numbered anew, because their numbers
/// follow from their ends. It keeps no mesh but the one before all splits.
class Split : public std::enable_shared_from_this<Split> {
 public:
  /// For make_split(), which checks the edit.
  Split(const MeshPointer& before, SplitEdit edit);
  ~Split();
  Split(const Split&) = delete;
  Split& operator=(const Split&) = delete;

  const SplitEdit& edit() const { return edit_; }
  /// Number of elements before it.
  ElementId old_count() const { return old_count_; }
  /// Returns mesh_size() before it.
  std::uint64_t old_size() const { return old_size_; }
  /// True if there were cells before it.
  bool had_cells() const { return had_cells_; }

  /// Return the meshes. See MeshSource::mesh().
  MeshPointer before() const { return before_.mesh(); }
  MeshPointer after() const { return MeshSource(shared_from_this()).mesh(); }

 private:
  friend class MeshSource;

  MeshPointer kept() const;
  MeshPointer make_after(const MeshPointer& before) const;

  SplitEdit edit_;
  ElementId old_count_;
  std::uint64_t old_size_;
  bool had_cells_;
  mutable MeshSource before_;
  mutable std::mutex mutex_;
  mutable std::weak_ptr<const Mesh> after_;
};

/// How the links of a mesh go over to the one after a split.
struct SplitLinks {
  static constexpr LinkId none = std::numeric_limits<LinkId>::max();

  /// `split` must live on.
  explicit SplitLinks(const Split& split);

  const SplitEdit& edit;
  MeshPointer before, after;
  /// For each link of the mesh after the split: the link before it on which it lies; none if it is inside a face
  /// or a cell.
  std::vector<LinkId> parents;
  /// For each appended element: the link on which it lies; none for others.
  std::vector<LinkId> link_of;

  /// Returns the link before the split on which an element lies; none if it is not on one, or if it is older.
  LinkId link_at(ElementId element) const {
    return element < before->element_count() ? none : link_of[element - before->element_count()];
  }
};

/// Returns the number of elements, links, triangles and cells together.
std::uint64_t mesh_size(const Mesh& mesh);

/// True if strokes may divide this mesh: it has cells, or it has faces and is not a lattice. A divided lattice of cells
/// is no longer a lattice.
bool can_split(const Mesh& mesh);
/// Throws Error at `where` if strokes may not divide this mesh.
void check_can_split(const Mesh& mesh, const std::string& where);

/// Returns those of the links that are neither the side of a face nor the edge of a cell.
std::vector<LinkId> links_without_faces(const Mesh& mesh, std::span<const LinkId> links);

/// Returns the rest positions of the elements of a mesh, and of elements that are appended to them.
std::vector<Point> rest_after(const Mesh& mesh, std::span<const SplitPoint> points);

/// Returns a split by an edit. Throws Error, with the reason, if it does not fit the mesh. The mesh after it is made
/// when it is asked for.
SplitPointer make_split(const MeshPointer& mesh, SplitEdit edit);

/// Returns the links that are cut after the split: those on cut links, and new ones inside cells and faces that are
/// gone, so that no piece of these comes back. Elements that would lose all links keep the first one. Ascending.
std::vector<LinkId> cuts_after(const SplitLinks& links, std::span<const LinkId> cuts);
std::vector<LinkId> cuts_after(const Split& split, std::span<const LinkId> cuts);
/// Returns the pins after the split: also the new elements all of whose elements are pinned. Ascending.
std::vector<ElementId> pins_after(const Split& split, std::span<const ElementId> pins);

}  // namespace chainmail

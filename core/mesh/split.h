#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
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

/// A mesh before and after a split, and how its links go over. The elements keep their ids. The links are numbered
/// anew, because their numbers follow from their ends.
struct Split {
  static constexpr LinkId none = std::numeric_limits<LinkId>::max();

  MeshPointer before, after;
  SplitEdit edit;
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

using SplitPointer = std::shared_ptr<const Split>;

/// True if strokes may divide this mesh: it has cells, or it has faces and is not a lattice. A divided lattice of cells
/// is no longer a lattice.
bool can_split(const Mesh& mesh);
/// Throws Error at `where` if strokes may not divide this mesh.
void check_can_split(const Mesh& mesh, const std::string& where);

/// Returns those of the links that are neither the side of a face nor the edge of a cell.
std::vector<LinkId> links_without_faces(const Mesh& mesh, std::span<const LinkId> links);

/// Returns the rest positions of the elements of a mesh, and of elements that are appended to them.
std::vector<Point> rest_after(const Mesh& mesh, std::span<const SplitPoint> points);

/// Applies an edit. Throws Error, with the reason, if it does not fit the mesh.
SplitPointer make_split(MeshPointer mesh, SplitEdit edit);

/// Returns the links that are cut after the split: those on cut links, and new ones inside cells and faces that are
/// gone, so that no piece of these comes back. Elements that would lose all links keep the first one. Ascending.
std::vector<LinkId> cuts_after(const Split& split, std::span<const LinkId> cuts);
/// Returns the pins after the split: also the new elements all of whose elements are pinned. Ascending.
std::vector<ElementId> pins_after(const Split& split, std::span<const ElementId> pins);

}  // namespace chainmail

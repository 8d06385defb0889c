#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/link_shares.h"
#include "mesh/progress.h"
#include "mesh/row_kinds.h"
#include "mesh/texture.h"

namespace chainmail {

/// Id of an element: its index in the file's order, from 0.
using ElementId = std::uint32_t;
/// Stands for an element that does not exist.
inline constexpr ElementId no_element = std::numeric_limits<ElementId>::max();
/// Id of a link: an unordered pair of elements, numbered by its first element, then in that element's order.
using LinkId = std::uint32_t;
/// Index of an entry in the neighbour table: a link as seen from one of its two elements.
using EntryId = std::uint32_t;
/// Meshes with more elements are refused before memory is allocated.
inline constexpr std::uint64_t element_limit = 20'000'000;

/// Coordinates beyond this (mesh units) are refused, so that their differences and squares stay finite.
inline constexpr double coordinate_limit = 1e100;

/// The regular arrangement of an object, if any: element i of W x H x D is at (i mod W, i / W mod H, i / (W·H)) times
/// the spacing (mesh units).
struct Lattice {
  std::array<std::uint32_t, 3> size{1, 1, 1};
  double spacing = 1;

  std::uint64_t element_count() const { return std::uint64_t{size[0]} * size[1] * size[2]; }
  Point position(ElementId element) const;
};

class Skin;
class Split;

/// Input of build_mesh, from a reader or a generator.
struct MeshParts {
  std::vector<Point> rest;
  /// Pairs in any order; duplicates are allowed. Ignored if the neighbour table is given.
  std::vector<std::array<ElementId, 2>> links;
  /// For files that list neighbours in their own order: row i is neighbours[first_entry[i] .. first_entry[i + 1]). Each
  /// link is in both rows.
  std::vector<EntryId> first_entry;
  std::vector<ElementId> neighbours;
  std::vector<std::array<ElementId, 3>> triangles;
  /// Faces with more than three corners: count, corner…, count, corner…
  std::vector<ElementId> polygons;
  std::vector<std::array<ElementId, 4>> tetrahedra;
  /// The corners of one side in order around it, then the opposite ones, as in VTK and Gmsh.
  std::vector<std::array<ElementId, 8>> hexahedra;
  std::optional<Lattice> lattice;
  /// Picture on the faces or sections, if any.
  std::shared_ptr<const Texture> texture;
  /// See Mesh::skin and Mesh::split.
  std::shared_ptr<const Skin> skin;
  std::shared_ptr<const Split> split;
  /// Mean rest length over the links (mesh units), if it is known.
  std::optional<double> mean_link_length;
  /// Requested space dimension. Default: the axes on which the rest positions are not constant.
  std::optional<int> space_dimension;
};

/// Rest positions, neighbour table, faces and cells. Immutable, and shared by everything that deforms it. Knows neither
/// softness nor algorithms.
struct Mesh {
  /// 1 chain, 2 surface, 3 volume.
  int object_dimension = 1;
  /// Number of coordinates that exist, and their axes: a 2D scene has no third.
  int space_dimension = 1;
  std::array<int, 3> axes{0, 1, 2};
  /// The constant coordinates on the axes that do not exist.
  Point origin = Point::Zero();

  /// Rest positions, element by element, space_dimension coordinates each (mesh units).
  std::vector<double> rest;
  /// Row e of the neighbour table is neighbours[first_entry[e] .. first_entry[e + 1]).
  std::vector<EntryId> first_entry;
  std::vector<ElementId> neighbours;
  /// The link of each entry of the neighbour table.
  std::vector<LinkId> entry_link;
  /// The distinct rest vectors of entries, space_dimension coordinates each (mesh units), and the index of the vector
  /// of each entry. Both are empty if there are more than shape_limit: a jittered mesh has one per link.
  std::vector<double> shapes;
  std::vector<std::uint16_t> entry_shape;
  static constexpr std::size_t shape_limit = 4096;
  /// The rows in short, if they are regular.
  RowKinds row_kinds;
  /// The two elements of each link, the smaller id first.
  std::vector<std::array<ElementId, 2>> links;

  /// Triangles to draw: first the faces of the object, then the triangles of its polygons, whose diagonals are not
  /// links.
  std::vector<std::array<ElementId, 3>> triangles;
  std::size_t own_triangles = 0;
  std::vector<ElementId> polygons;
  std::vector<std::array<ElementId, 4>> tetrahedra;
  std::vector<std::array<ElementId, 8>> hexahedra;
  std::optional<Lattice> lattice;
  std::shared_ptr<const Texture> texture;
  /// The surface before splits of cells; null without splits, when all of the surface is skin.
  std::shared_ptr<const Skin> skin;
  /// The split that made it from another mesh; null if none did. See MeshSource.
  std::shared_ptr<const Split> split;
  /// Number of parts that no link joins.
  std::uint32_t part_count = 0;
  /// True for a rectangular mesh: elements in a lattice, with links to the next element along its axes only.
  bool is_grid = false;
  /// Mean rest length over the links (mesh units); 0 without links.
  double mean_link_length = 0;
  /// Axis-aligned bounds of the rest positions, as two corners (mesh units).
  std::array<Point, 2> box{Point::Zero(), Point::Zero()};
  /// How much material each link stands for, found when it is first needed.
  LinkShares shares;

  ElementId element_count() const { return static_cast<ElementId>(first_entry.size() - 1); }
  LinkId link_count() const { return static_cast<LinkId>(links.size()); }
  /// True if it has tetrahedra or hexahedra.
  bool has_cells() const { return !tetrahedra.empty() || !hexahedra.empty(); }
  std::span<const ElementId> neighbours_of(ElementId element) const {
    return {neighbours.data() + first_entry[element], neighbours.data() + first_entry[element + 1]};
  }
  /// True if a coordinate exists along an axis (0 x, 1 y, 2 z).
  bool has_axis(int axis) const;
  /// Rest position with all three coordinates.
  Point rest_position(ElementId element) const;
  /// Returns a point with all three coordinates, from the space_dimension ones that exist.
  Point to_point(const double* coordinates) const;
};

using MeshPointer = std::shared_ptr<const Mesh>;

/// Throw Error if there is no such element or link.
void check_element(const Mesh& mesh, ElementId element);
void check_elements(const Mesh& mesh, std::span<const ElementId> elements);
void check_links(const Mesh& mesh, std::span<const LinkId> links);
/// Throw Error at `where` if a coordinate is not a finite number, or if it is on an axis that does not exist. There, a
/// displacement is 0, and a position is 0 or that of the object.
void check_position(const Mesh& mesh, const std::string& where, const Point& position);
void check_displacement(const Mesh& mesh, const std::string& where, const Point& displacement);
/// Throws Error at `where`: the object does not extend along this axis.
[[noreturn]] void refuse_axis(const std::string& where, int axis);

inline std::array<Point, 2> bounds(const Mesh& mesh) { return mesh.box; }
/// True if the object lies far from the origin for its size: its absolute coordinates have fewer digits in single
/// precision than those about its middle, as in data of a survey.
bool is_far(const Mesh& mesh);

/// Length of a link at rest (mesh units).
double rest_length(const Mesh& mesh, LinkId link);

/// Returns the link between two elements, if any. Takes time in proportion to the shorter of the two rows.
std::optional<LinkId> find_link(const Mesh& mesh, ElementId a, ElementId b);

/// Builds a mesh from its parts.
///
/// The parts must be consistent (ids below the number of elements, no link from an element to itself, a given neighbour
/// table symmetric and without duplicates): readers check this, with messages in terms of their file. Throws Error if
/// the requested space dimension would flatten the object or the parts exceed element_limit, and Cancelled.
MeshPointer build_mesh(MeshParts parts, const Progress& progress = {});

}  // namespace chainmail

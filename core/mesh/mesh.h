#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesh/progress.h"
#include "mesh/texture.h"

namespace chainmail {

/// A point of the object, by its place in the file's order, from 0.
using ElementId = std::uint32_t;
/// An unordered pair of elements, numbered by its first element, then in that element's order.
using LinkId = std::uint32_t;
/// A place in the neighbour table: a link as seen from one of its two elements.
using EntryId = std::uint32_t;
/// More elements than this are refused before memory is taken.
inline constexpr std::uint64_t element_limit = 20'000'000;

/// Coordinates beyond this (mesh units) are refused: their differences and squares must stay finite.
inline constexpr double coordinate_limit = 1e100;

/// The regular arrangement an object stands in, where it has one: element i of W x H x D stands at
/// (i mod W, i / W mod H, i / (W·H)) times the spacing (mesh units).
struct Lattice {
  std::array<std::uint32_t, 3> size{1, 1, 1};
  double spacing = 1;

  std::uint64_t element_count() const { return std::uint64_t{size[0]} * size[1] * size[2]; }
  Point position(ElementId element) const;
};

/// What a reader or a generator hands over; build_mesh makes a Mesh of it.
struct MeshParts {
  std::vector<Point> rest;
  /// Pairs in any order, doubles allowed. Not looked at where the neighbour table is given.
  std::vector<std::array<ElementId, 2>> links;
  /// Where the file lists neighbours in an order of its own: row i is
  /// neighbours[first_entry[i] .. first_entry[i + 1]). Each link stands in both its rows.
  std::vector<EntryId> first_entry;
  std::vector<ElementId> neighbours;
  std::vector<std::array<ElementId, 3>> triangles;
  /// Faces of more than three corners: count, corner…, count, corner…
  std::vector<ElementId> polygons;
  std::vector<std::array<ElementId, 4>> tetrahedra;
  /// The corners of one side in a row about it, then those opposite of them, as in VTK and Gmsh.
  std::vector<std::array<ElementId, 8>> hexahedra;
  std::optional<Lattice> lattice;
  /// What its faces or sections show, if anything.
  std::shared_ptr<const Texture> texture;
  /// Space dimension asked for; by default the axes on which the rest positions are not constant.
  std::optional<int> space_dimension;
};

/// What is there: rest positions, neighbour table, faces and cells. Immutable and shared by
/// everything that deforms it; it knows neither softness nor algorithms.
struct Mesh {
  /// 1 chain, 2 surface, 3 volume.
  int object_dimension = 1;
  /// How many coordinates exist, and which ones: a plane scene carries no third.
  int space_dimension = 1;
  std::array<int, 3> axes{0, 1, 2};
  /// The constant coordinates on the axes that are not carried.
  Point origin = Point::Zero();

  /// Rest positions, element by element, space_dimension coordinates each (mesh units).
  std::vector<double> rest;
  /// Row e of the neighbour table is neighbours[first_entry[e] .. first_entry[e + 1]).
  std::vector<EntryId> first_entry;
  std::vector<ElementId> neighbours;
  /// The link of each entry of the neighbour table.
  std::vector<LinkId> entry_link;
  /// The distinct rest vectors of entries, space_dimension coordinates each (mesh units), and the one of each
  /// entry. Both empty where there are more than shape_limit: a jittered mesh has one a link.
  std::vector<double> shapes;
  std::vector<std::uint16_t> entry_shape;
  static constexpr std::size_t shape_limit = 4096;
  /// The two elements of each link, the smaller id first.
  std::vector<std::array<ElementId, 2>> links;

  /// Triangles to draw: first the object's own faces, then those its polygons were split into,
  /// whose diagonals are no links.
  std::vector<std::array<ElementId, 3>> triangles;
  std::size_t own_triangles = 0;
  std::vector<ElementId> polygons;
  std::vector<std::array<ElementId, 4>> tetrahedra;
  std::vector<std::array<ElementId, 8>> hexahedra;
  std::optional<Lattice> lattice;
  std::shared_ptr<const Texture> texture;
  /// How many parts there are that no link joins.
  std::uint32_t part_count = 0;
  /// Whether it is rectangular: elements in a lattice, and links along its axes alone, one step each.
  bool is_grid = false;
  /// Mean rest length over the links (mesh units); 0 without links.
  double mean_link_length = 0;
  /// Axis-aligned bounds of the rest positions, as two corners (mesh units).
  std::array<Point, 2> box{Point::Zero(), Point::Zero()};

  ElementId element_count() const { return static_cast<ElementId>(first_entry.size() - 1); }
  LinkId link_count() const { return static_cast<LinkId>(links.size()); }
  std::span<const ElementId> neighbours_of(ElementId element) const {
    return {neighbours.data() + first_entry[element], neighbours.data() + first_entry[element + 1]};
  }
  /// Rest position with all three coordinates.
  Point rest_position(ElementId element) const;
  /// Puts the carried coordinates (space_dimension of them) among the constant ones.
  Point to_point(const double* carried) const;
};

using MeshPointer = std::shared_ptr<const Mesh>;

inline std::array<Point, 2> bounds(const Mesh& mesh) { return mesh.box; }

/// Length of a link at rest (mesh units).
double rest_length(const Mesh& mesh, LinkId link);

/// The link between two elements, if there is one. Time: the shorter of the two rows.
std::optional<LinkId> find_link(const Mesh& mesh, ElementId a, ElementId b);

/// Builds the neighbour table and all that follows from the parts.
///
/// The parts must be consistent (ids below the number of elements, no link to itself, a given
/// neighbour table symmetric and without doubles): readers check this, each in its file's terms.
/// Throws Error where the space dimension asked for would flatten the object, and where the parts
/// exceed element_limit, and Cancelled.
MeshPointer build_mesh(MeshParts parts, const Progress& progress = {});

}  // namespace chainmail

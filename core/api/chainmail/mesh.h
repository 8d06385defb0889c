#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chainmail/types.h"

namespace chainmail::api {

struct Access;

/// Largest number of elements of a mesh.
inline constexpr ElementId element_limit = 20'000'000;
/// Largest size of a coordinate (mesh units).
inline constexpr double coordinate_limit = 1e100;

/// An object at rest: elements, the links between them, faces and cells. Immutable; copies share the data, and cost as
/// much as a pointer. Make one with make_line() … make_tetra(), make_mesh() or read_mesh().
///
/// Every function that takes an id throws Error if there is no such element or link.
class Mesh {
 public:
  /// Number of elements. Their ids are 0 to element_count() - 1.
  ElementId element_count() const;
  /// Number of links. Their ids are 0 to link_count() - 1.
  LinkId link_count() const;

  /// The elements that an element is linked to: in the order of the file if it lists them (.dat), otherwise ascending.
  /// Valid while a copy of the mesh exists.
  std::span<const ElementId> neighbours(ElementId element) const;
  /// The two elements of each link, the smaller id first. Valid while a copy of the mesh exists.
  std::span<const std::array<ElementId, 2>> links() const;
  /// The two elements of a link, the smaller id first.
  std::array<ElementId, 2> link(LinkId link) const;
  /// Returns the link between two elements, if any.
  std::optional<LinkId> find_link(ElementId a, ElementId b) const;

  /// Position of an element at rest (mesh units).
  Vector3 rest_position(ElementId element) const;
  /// The positions of all elements at rest: x, y and z, element by element (mesh units).
  std::vector<double> rest_positions() const;
  /// Length of a link at rest (mesh units).
  double rest_length(LinkId link) const;
  /// Mean rest length over all links (mesh units); 0 without links.
  double mean_rest_length() const;
  /// Lowest and highest corner of the box around the rest positions (mesh units).
  std::array<Vector3, 2> bounds() const;

  /// 1 for a chain, 2 for a surface, 3 for a volume.
  int object_dimension() const;
  /// Number of coordinates that exist: on a line there is no y, in a plane there is no z.
  int space_dimension() const;
  /// The axes that exist: `xyz`, or `xy` in a plane.
  std::string axes() const;
  /// Number of parts that no link joins.
  std::uint32_t part_count() const;
  /// Numbers of elements along x, y and z, if the elements are in a lattice. Element i is then at (i mod w, i / w mod
  /// h, i / (w·h)).
  std::optional<std::array<std::uint32_t, 3>> lattice() const;
  /// True for a lattice whose links run along the axes only. 3D ChainMail works on these meshes only.
  bool is_grid() const;

  /// Corners of the triangles of the object. Polygons of a file are not among them. Valid while a copy of the mesh
  /// exists, like those of the cells.
  std::span<const std::array<ElementId, 3>> triangles() const;
  /// Corners of the tetrahedra.
  std::span<const std::array<ElementId, 4>> tetrahedra() const;
  /// Corners of the hexahedra: those of one side in order around it, then the opposite ones.
  std::span<const std::array<ElementId, 8>> hexahedra() const;

  /// Returns the elements at a side, ascending: `left` (lowest x), `right`, `bottom` (lowest y), `top`, `back` (lowest
  /// z), `front`, or `boundary` (outer surface, open edges or ends). Throws Error for another name, and if the mesh has
  /// no such side.
  std::vector<ElementId> side(std::string_view name) const;

  /// What the reader of a file remarks about it: the density from which voxels became elements, or flaws that were left
  /// out. Usually empty.
  const std::string& remark() const;

  /// True for two copies of the same mesh. Meshes with the same content that were made twice differ.
  bool operator==(const Mesh& other) const;
  /// The same for all copies of a mesh, and for no other one while one of them exists.
  const void* identity() const;

 private:
  friend struct Access;
  struct Impl;
  explicit Mesh(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Options of generated meshes.
struct LatticeOptions {
  double spacing = 1;  ///< Distance between neighbouring elements (mesh units), above 0.
  /// Number of coordinates: 3 lets a sheet leave its plane. Default: as many as the object extends along.
  std::optional<int> space_dimension = {};
};

// Each of these functions numbers elements along x, then y, then z. It throws Error for a size of 0, for more than
// 20 million elements, and for options out of their range.

/// Returns a chain of elements along x.
Mesh make_line(std::uint32_t length, const LatticeOptions& options = {});
/// Returns a grid in the plane of x and y, with links along the axes.
Mesh make_grid(std::uint32_t width, std::uint32_t height, const LatticeOptions& options = {});
/// Returns a sheet of triangles: a grid whose squares are split by a diagonal.
Mesh make_cloth(std::uint32_t width, std::uint32_t height, const LatticeOptions& options = {});
/// Returns a block of elements with links along the three axes.
Mesh make_block(std::uint32_t width, std::uint32_t height, std::uint32_t depth, const LatticeOptions& options = {});
/// Returns a block of tetrahedra: each cube is split into six (Freudenthal 1942).
Mesh make_tetra(std::uint32_t width, std::uint32_t height, std::uint32_t depth, const LatticeOptions& options = {});

/// Content of a mesh, as flat arrays of ids and coordinates. They are copied.
struct MeshArrays {
  std::span<const double> positions = {};      ///< Rest positions: x, y, z per element (mesh units).
  std::span<const ElementId> links = {};       ///< Two elements per link. The edges of faces and cells are links too.
  std::span<const ElementId> triangles = {};   ///< Three corners per triangle.
  std::span<const ElementId> tetrahedra = {};  ///< Four corners per tetrahedron.
  /// Eight corners per hexahedron: those of one side in order around it, then the opposite ones.
  std::span<const ElementId> hexahedra = {};
  std::optional<int> space_dimension = {};  ///< Number of coordinates. Default: those that are not constant.
};

/// Returns a mesh from arrays. Throws Error for an array of the wrong size, a coordinate that is not finite, an id
/// without a position, a link, face or cell that uses an element twice, a face or cell that is there twice, and if
/// there is no link.
Mesh make_mesh(const MeshArrays& arrays);

}  // namespace chainmail::api

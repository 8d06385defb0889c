#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "chainmail/mesh.h"
#include "chainmail/types.h"

namespace chainmail::api {

struct Access;

/// How far a link may shorten, lengthen and lean, relative to its rest vector (thesis of Dean 2004, 3.1), and how
/// strongly relaxation returns it to its rest vector (see elastic_energy).
struct LinkSoftness {
  double compression = 0.8;  ///< Shortest length along each axis, of rest length: 0 (no limit) to 1 (rigid).
  double stretch = 1.2;      ///< Greatest length along each axis, of rest length: 1 (rigid) or more.
  double shear = 0.1;        ///< How far it may lean, per length along the other axes: 0 or more.
  double lateral = 1;        ///< Stiffness against sideways motion, per stiffness along the link: 0 or more.
  double stiffness = 1;      ///< Stiffness along the link, relative to other links: above 0.
  double exponent = -1;      ///< Power of its rest length by which its stiffness is multiplied: -4 to 4.

  /// True if all values are equal.
  bool operator==(const LinkSoftness&) const = default;
};

/// A number of a link's softness, for programs that show or set all of them.
struct SoftnessNumber {
  std::string_view name;        ///< Its name, as on the command line and in files.
  std::string_view unit;        ///< Its unit; empty for a number without one.
  std::string_view help;        ///< What it means, in a few words.
  double lowest;                ///< Lowest value.
  double highest;               ///< Highest value; the largest number if there is no limit.
  double LinkSoftness::*value;  ///< The number.
};
/// The numbers of a link's softness, in the order of LinkSoftness.
std::span<const SoftnessNumber> softness_numbers();

/// The elastic energy, which relaxation lowers. See elastic_energy for the formulas.
enum class EnergyKind {
  isotropic,  ///< Links resist motion along them and across them alike. Their stiffness does not count.
  axial,  ///< Links resist motion along their rest vectors, and across them in the share of their lateral stiffness.
  corotated,  ///< Links are springs, and resist motion across their rest vectors turned with their surroundings.
  /// Cells resist as a material with Poisson's ratio, a surface in space as a thin shell of it. Without cells and
  /// faces, links are corotated.
  material
};

/// How the energy of an elastic material grows with the strain. At small strains, all are the same linear elasticity.
enum class StrainLaw {
  neo_hookean,  ///< It does not stiffen.
  gent,  ///< It stiffens toward a limit of I₁ − 3, the sum of the squared principal stretches less 3 (Gent 1996).
  fung   ///< It stiffens exponentially (Demiray 1972).
};

/// Settings of the methods of elasticity, of free-form deformation and of relaxation to the material.
struct Elasticity {
  double young = 1;      ///< Young's modulus (force per square of a mesh unit), above 0. It does not change the shape.
  double poisson = 0.3;  ///< Poisson's ratio: 0 to below 0.5.
  /// Number of control points of free-form deformation along each axis, 2 to 8.
  std::array<std::uint32_t, 3> control_points{4, 4, 4};
  /// Most iterations of a method that iterates, for one move, 1 to 100000. They stop earlier if they converge.
  std::uint32_t iterations = 2000;
  /// Law of relaxation to the material and of neo-Hookean FEM.
  StrainLaw law = StrainLaw::neo_hookean;
  double gent_limit = 2;       ///< With `gent`: bound of I₁ − 3, above 0; higher for a lower Poisson's ratio.
  double fung_exponent = 0.5;  ///< With `fung`: factor of I₁ − 3, above 0; lower for a lower Poisson's ratio.
  /// Thickness of a surface in space in relaxation to the material, as a share of the longest side of its bounds:
  /// 0.0001 to 1.
  double thickness = 0.01;

  /// True if all values are equal.
  bool operator==(const Elasticity&) const = default;
};

/// Throws Error about the first setting, as `poisson` or `gent-limit`, that is out of its range or contradicts another.
void check(const Elasticity& elasticity);

/// The positions of an object at one time. Copies share the data.
class Snapshot {
 public:
  /// True if both contain the same positions, bit for bit.
  bool operator==(const Snapshot& other) const;
  /// The object at rest.
  const Mesh& mesh() const;

 private:
  friend struct Access;
  struct Impl;
  explicit Snapshot(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// The positions of an object as they are stored: a row of numbers for each element.
struct StoredPositions {
  const void* first = nullptr;                        ///< First number of element 0.
  Precision precision = Precision::double_precision;  ///< Type of the numbers.
  int columns = 0;                                    ///< Numbers in a row: one for each axis of Mesh::axes().
  std::size_t stride = 0;                             ///< Bytes from one row to the next.
};

/// The state of one object: positions, cuts, pins and softness. Copies are independent.
///
/// Arrays of positions contain x, y and z for each element, in the order of the ids (mesh units): 3 · element_count()
/// numbers. A coordinate that does not exist (z in a plane) is constant and must stay so. Every function that takes ids
/// throws Error if one does not exist; nothing has changed then. One thread at a time may use a body.
class Body {
 public:
  /// Makes an object at rest, without cuts and pins, with the default softness and that of the file (see read_mesh()).
  explicit Body(const Mesh& mesh, Precision precision = Precision::double_precision);
  /// Copies the state. Elements that cuts or unpinned elements woke for relaxation are not part of it.
  Body(const Body& other);
  /// Moves the state; `other` may then only be assigned to or destroyed.
  Body(Body&& other) noexcept;
  /// Copies the state. Elements that cuts or unpinned elements woke for relaxation are not part of it.
  Body& operator=(const Body& other);
  /// Moves the state; `other` may then only be assigned to or destroyed.
  Body& operator=(Body&& other) noexcept;
  ~Body();

  /// The object at rest.
  const Mesh& mesh() const;
  /// Type of the numbers that store the positions.
  Precision precision() const;

  /// Position of an element (mesh units).
  Vector3 position(ElementId element) const;
  /// Returns the positions of all elements.
  std::vector<double> positions() const;
  /// Writes the positions of all elements into an array, without allocating memory. Throws Error if it has another
  /// size.
  void copy_positions(std::span<double> out) const;
  /// Returns the positions as they are stored, without a copy; they show every later move. Valid until the body is
  /// assigned to or destroyed, its axes are turned, or a Deformer uses a method on it for which
  /// keeps_stored_positions() is false. Throws Error if something else is stored: displacements from rest, with the
  /// method `exact` and in single precision far from the origin, or coordinates along turned axes.
  StoredPositions stored_positions() const;
  /// True if a Deformer with this method leaves the positions where and as they are stored. Throws Error for an unknown
  /// name.
  bool keeps_stored_positions(std::string_view method) const;
  /// Sets the positions of all elements, also of pinned ones. They are rounded to the precision. Throws Error if the
  /// array has another size, or if a coordinate is not finite, out of the range of the precision, or on an axis that
  /// does not exist.
  void set_positions(std::span<const double> positions);
  /// Moves all elements to rest. Cuts, pins and softness stay.
  void reset();

  /// Returns the positions, to restore them later. Cuts, pins and softness are not part of it.
  Snapshot snapshot() const;
  /// Restores positions, bit for bit. Throws Error if the snapshot is of another mesh or precision.
  void restore(const Snapshot& snapshot);

  /// Cuts links. Nothing is renumbered. Links that are cut already stay cut.
  void cut(const std::vector<LinkId>& links);
  /// Cuts the link between two elements. Throws Error if they are not linked.
  void cut(ElementId a, ElementId b);
  /// Restores cut links.
  void uncut(const std::vector<LinkId>& links);
  /// Returns the cut links, ascending.
  std::vector<LinkId> cuts() const;
  /// True if the link is cut.
  bool is_cut(LinkId link) const;

  /// Pins elements at their current positions: no method moves them, and a move of a pinned element is an error.
  void pin(const std::vector<ElementId>& elements);
  /// Unpins elements.
  void unpin(const std::vector<ElementId>& elements);
  /// The pinned elements, ascending. Valid until pins change.
  std::span<const ElementId> pins() const;
  /// True if the element is pinned.
  bool is_pinned(ElementId element) const;

  /// Sets the softness of all links that have none of their own. Nothing moves; the next move answers. Throws Error if
  /// a value is out of its range.
  void set_softness(const LinkSoftness& softness);
  /// Gives links their own softness.
  void set_softness(const std::vector<LinkId>& links, const LinkSoftness& softness);
  /// Gives each of these links its own softness, one for each link. Throws Error if a link is given twice.
  void set_link_softness(const std::vector<LinkId>& links, std::span<const LinkSoftness> softness);
  /// Takes their own softness away from links: the common one applies to them.
  void clear_softness(const std::vector<LinkId>& links);
  /// The softness of all links that have none of their own.
  LinkSoftness softness() const;
  /// The softness of a link.
  LinkSoftness softness(LinkId link) const;
  /// Returns the softness of each link.
  std::vector<LinkSoftness> link_softness() const;

  /// Sets the kind of elastic energy. Nothing moves; relaxation uses it from now on. A new body has
  /// that of the material. A global lateral stiffness that was the usual one of the old kind becomes that of the new
  /// kind: 0.03 for axial energy, else 1.
  void set_energy(EnergyKind kind);
  /// The kind of elastic energy.
  EnergyKind energy() const;

  /// Turns the axes along which valid regions lie, of all links: `rotation` leads from the axes of the world, which a
  /// new body has, to them. An object that is turned together with its axes and its moves deforms in the same way.
  /// Nothing moves; the next move answers. Methods of elasticity ignore it. Throws Error if the rotation has no axis or
  /// leaves the space of the object.
  void set_frame(const Rotation& rotation);
  /// Turns these axes to the principal axes of the object at rest, with the order and the signs nearest to the axes of
  /// the world. Returns false if some do not exist, as for a cube: the axes nearest to those of the world are used
  /// then.
  bool set_frame_of_object();
  /// The rotation from the axes of the world to these axes.
  Rotation frame() const;

  /// Returns the triangles to draw: the faces without a cut link, with polygons divided, and the outer faces of the
  /// cells, also where cuts separate them.
  std::vector<std::array<ElementId, 3>> visible_triangles() const;

  /// Sets the settings of the methods of elasticity. Throws Error if a value is out of its range.
  void set_elasticity(const Elasticity& elasticity);
  /// The settings of the methods of elasticity.
  Elasticity elasticity() const;

 private:
  friend struct Access;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace chainmail::api

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "chainmail/job.h"
#include "chainmail/mesh.h"

namespace chainmail::api {

/// Returns the figures of a mesh, its flaws and its defects for readers, a line each.
std::string describe(const Mesh& mesh);
/// Returns the same as JSON, as `chainmail info --json` writes it. Throws Error if the library was built without
/// nlohmann/json.
std::string describe_json(const Mesh& mesh);

/// What repair() does.
struct RepairOptions {
  bool weld = true;      ///< Welds duplicates: elements at the position of another one become one with it.
  double tolerance = 0;  ///< Elements this close to another one are duplicates (mesh units).
  bool loose = true;     ///< Removes elements without links.
  bool holes = true;     ///< Closes holes of a surface. The outline of an open surface stays.
  bool cells = true;     ///< Turns cells that are inside out while others are not.
};

/// A mesh after repair().
class Repair {
 public:
  /// The mesh.
  const Mesh& mesh() const;
  /// Returns what was done and what is left, for readers, a line each.
  std::string text() const;
  /// Returns counts before and after as JSON, as `chainmail repair --json` writes it. Throws Error if the library was
  /// built without nlohmann/json.
  std::string json() const;

 private:
  friend struct Access;
  struct Impl;
  explicit Repair(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Repairs a mesh: welds duplicates, removes loose elements, closes holes with triangles, and turns cells. Elements are
/// numbered again where some are gone; links keep their own softness. Edges of more than two faces are counted but not
/// changed. Closing holes needs chainmail-import (see ReadOptions). Throws Error about the `surface` if no hole can be
/// closed; and Cancelled.
Repair repair(const Mesh& mesh, const RepairOptions& options = {}, const Job& job = {});

/// Smallest number of elements for simplify(): a tetrahedron has 4 corners.
inline constexpr std::uint32_t fewest_simplified = 4;
/// Returns a surface with this number of elements: it collapses edges, those that change the shape least first
/// (Lindstrom and Turk 1998). Faces become triangles. A closed surface stays closed; elements at the border of an open
/// one stay where they are. Needs chainmail-import. Throws Error about the `elements` if the surface has no more than
/// that, or if there are fewer than fewest_simplified; about the `surface` if it has cells or cannot have so few
/// elements; and Cancelled.
Mesh simplify(const Mesh& surface, std::uint64_t elements, const Job& job = {});

/// Fills a closed surface with tetrahedra whose edges are about `size` long (mesh units); by default as long as its
/// mean edge. The elements of the surface keep their ids; inner elements follow. Needs chainmail-import. Throws Error
/// about the `surface` if it is open, intersects itself or cannot be filled, about the `size`; and Cancelled.
Mesh fill(const Mesh& surface, std::optional<double> size = {}, const Job& job = {});

}  // namespace chainmail::api

#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "body/softness.h"
#include "files/repair/defects.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// A mesh after a repair, and where its elements were before.
struct Repaired {
  static constexpr ElementId gone = std::numeric_limits<ElementId>::max();

  MeshPointer mesh;
  /// The new id of each element of the mesh before; `gone` if it was removed.
  std::vector<ElementId> new_ids;
};

/// Joins the elements within `tolerance` (mesh units; 0: at exactly the same position) to the one with the lowest id,
/// see first_within(). Links between them are left out, and so are faces and cells that then use an element twice or
/// are duplicates of others. Throws Cancelled.
Repaired weld(const Mesh& mesh, double tolerance = 0, const Progress& progress = {});

/// Removes the elements without links, unless the mesh has no links. Throws Cancelled.
Repaired remove_loose(const Mesh& mesh, const Progress& progress = {});

/// Closes holes (see Defects::holes) with triangles, by CGAL in the import program. Inside a large hole there are new
/// elements, so that the new triangles are about as large as those around them; a flat hole gets a flat patch. All
/// elements, links and faces stay; new ones follow.
///
/// Throws Error about the `surface` if it has cells or if no hole can be closed; and Cancelled. A single hole that
/// cannot be closed stays open.
Repaired close_holes(const Mesh& mesh, const std::vector<std::vector<ElementId>>& holes, const Progress& progress = {});

/// Turns cells that are inside out (see Defects::inverted): they list their corners in the opposite order. Throws
/// Cancelled.
Repaired turn_cells(const Mesh& mesh, const std::vector<std::uint32_t>& cells, const Progress& progress = {});

/// Returns the softness of single links of `before` for the same links after a repair.
OwnSoftness softness_after(const OwnSoftness& own, const Mesh& before, const Repaired& after);

/// The repairs that repair() makes, in their order.
struct RepairOptions {
  bool weld = true;
  double tolerance = 0;  // of weld() (mesh units)
  bool loose = true, holes = true, cells = true;
};
/// A mesh before and after several repairs.
struct RepairResult {
  MeshPointer before, mesh;
  OwnSoftness softness;  // of single links
  Defects defects_before, defects;
  std::vector<std::string> done;  // '3 duplicate vertices welded'
};
/// Repairs the defects of a mesh. Throws what these repairs throw.
RepairResult repair(const MeshPointer& mesh, const OwnSoftness& softness, const RepairOptions& options,
                    const Progress& progress = {});

}  // namespace chainmail

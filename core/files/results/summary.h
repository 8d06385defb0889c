#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "body/handle.h"
#include "equilibrium/equilibrium_solver.h"
#include "files/mesh/open_mesh.h"
#include "files/repair/defects.h"
#include "measure/violation.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Figures of a mesh.
struct MeshSummary {
  std::uint64_t elements = 0;
  std::uint64_t links = 0;
  std::uint64_t triangles = 0;  // as drawn, including those of polygons
  std::uint64_t tetrahedra = 0;
  std::uint64_t hexahedra = 0;
  int object_dimension = 1;
  int space_dimension = 1;
  std::uint64_t components = 0;  // parts without a link between them
  std::array<Point, 2> bounds{Point::Zero(), Point::Zero()};
  double mean_link_length = 0;
  MeshFlaws flaws;
  Defects defects;
  std::string remark;  // how voxels became elements; usually empty
};
/// Leaves flaws, defects and the remark empty.
MeshSummary summarize(const Mesh& mesh);
MeshSummary summarize(const OpenedMesh& opened);
void write_json(std::ostream& out, const MeshSummary& summary);

/// A mesh before and after a repair.
struct RepairSummary {
  MeshSummary before, after;
};
void write_json(std::ostream& out, const RepairSummary& summary);

/// The passes of a deformation, and the state of the object after them.
struct DeformSummary {
  struct Pass {
    std::vector<ElementId> handle;  // ascending
    Point target = Point::Zero();   // of its pivot (mesh units)
    Rotation rotation = {};         // since it was grabbed
    std::uint64_t checked = 0;
    std::uint64_t moved = 0;
    double milliseconds = 0;
    std::optional<Point> stopped_at = {};  // where the pivot is, if the handle stopped before its target (mesh units)
    std::string remark = {};               // reason why it did not end as requested; usually empty
  };

  std::string algorithm;
  std::uint64_t elements = 0;
  std::uint64_t links = 0;
  std::vector<Pass> passes;
  Violation violation;
  double energy = 0;
  Displacement displacement;
  // Figures about the shape; none where they are not defined.
  std::optional<double> volume_change = {};                // relative
  std::optional<std::uint64_t> inverted_cells = {};        // number of them
  std::optional<double> largest_stretch = {};              // principal stretch
  std::optional<EquilibriumCertificate> equilibrium = {};  // if it was relaxed to the equilibrium
};
void write_json(std::ostream& out, const DeformSummary& summary);

}  // namespace chainmail

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "files/mesh/open_mesh.h"
#include "files/repair/defects.h"
#include "files/repair/repair.h"
#include "mesh/mesh.h"
#include "simulate/deformation.h"

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
  std::optional<CellFigures> cells;  // of an object with cells
  MeshFlaws flaws;
  Defects defects;
  std::string remark;  // how voxels became elements; usually empty
};
/// Leaves flaws, defects and the remark empty.
MeshSummary summarize(const Mesh& mesh);
MeshSummary summarize(const OpenedMesh& opened);
void write_json(std::ostream& out, const MeshSummary& summary);

/// Writes counts before and after a repair.
void write_json(std::ostream& out, const RepairResult& repair);

void write_json(std::ostream& out, const DeformSummary& summary);
/// Returns notes about passes that did not converge or stopped before their target. Usually empty.
std::vector<std::string> notes_of(const DeformSummary& summary);

// Each of these functions writes a result for readers.
void write_text(std::ostream& out, const MeshSummary& summary);
/// What was done and what is left, a line each.
void write_text(std::ostream& out, const RepairResult& repair);
void write_text(std::ostream& out, const DeformSummary& summary);
/// What was found. The errors are in a table of their own: see results_of.
void write_text(std::ostream& out, const CalibrationOptions& options, const CalibrationResult& result);

}  // namespace chainmail

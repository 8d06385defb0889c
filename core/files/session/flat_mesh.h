#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// A mesh as arrays of numbers, as other processes hand it over. Nothing about them is certain.
struct FlatMesh {
  std::vector<double> rest;           // x, y and z of each element (mesh units)
  std::vector<EntryId> first_entry;   // of the row of each element in the neighbour table, and the end of the last row
  std::vector<ElementId> neighbours;  // the rows
  std::vector<ElementId> triangles;   // three each
  std::vector<ElementId> polygons;    // count, corner…, count, corner…
  std::vector<ElementId> tetrahedra;  // four each
  std::vector<ElementId> hexahedra;   // eight each
  std::optional<Lattice> lattice;
  std::int64_t space_dimension = 3;
};

FlatMesh flat_mesh_of(const Mesh& mesh);

/// Builds a mesh after the same checks as for a mesh in a session. `where` begins the errors. Throws Error and
/// Cancelled.
MeshPointer checked_mesh(FlatMesh flat, const std::string& where, const Progress& progress = {});

}  // namespace chainmail

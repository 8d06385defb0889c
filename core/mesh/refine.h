#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// A mesh whose cells are parts of the cells of another one. Its first elements are those of the other, with the same
/// ids. Each further element is in the middle between two elements with lower ids.
struct Refinement {
  MeshPointer mesh;
  std::vector<std::array<ElementId, 2>> parents;  // of the further elements, in their order
};

/// Halves all edges: a tetrahedron becomes eight, a triangle four, and a link of an object without faces and cells two.
/// Curved surfaces stay as they are: new elements lie on the old faces. The four inner tetrahedra follow Bey (1995), so
/// that repeated refinement of a tetrahedron makes at most three shapes. They keep its orientation.
///
/// The links of the result are the edges of its cells, its faces, or its halved links. Faces of a mesh with tetrahedra
/// are left out. Throws Error if the mesh has hexahedra, polygons or too many elements, and Cancelled.
Refinement refine(const Mesh& mesh, const Progress& progress = {});

/// Returns values of the elements of a mesh, `dimension` each, with those of the further elements of its refinement:
/// the means of their parents.
std::vector<double> interpolated(const Refinement& finer, const std::vector<double>& values, int dimension);

}  // namespace chainmail

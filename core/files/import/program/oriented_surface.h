#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "mesh/mesh.h"

namespace chainmail::import {

using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Halfedges = CGAL::Surface_mesh<SurfaceKernel::Point_3>;
using Halfedge = Halfedges::Halfedge_index;

/// The triangles of a surface as halfedges. They need faces with one orientation and at most two at an edge: where that
/// is not so, the surface is taken apart, with copies of elements.
class OrientedSurface {
 public:
  explicit OrientedSurface(const MeshParts& parts);

  Halfedges& halfedges() { return halfedges_; }
  const Halfedges& halfedges() const { return halfedges_; }
  /// The element that each vertex is, or is a copy of. The vertices of elements come first, those of copies follow.
  const std::vector<ElementId>& originals() const { return original_; }

 private:
  using Faces = std::vector<std::vector<std::size_t>>;

  void find_originals(const MeshParts& parts, const std::vector<SurfaceKernel::Point_3>& points, const Faces& faces);

  Halfedges halfedges_;
  std::vector<ElementId> original_;
};

}  // namespace chainmail::import

#include "files/import/program/oriented_surface.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include <algorithm>

namespace chainmail::import {

OrientedSurface::OrientedSurface(const MeshParts& parts) {
  std::vector<SurfaceKernel::Point_3> points;
  for (const Point& p : parts.rest) {
    points.emplace_back(p.x(), p.y(), p.z());
  }
  Faces faces;
  for (const auto& t : parts.triangles) {
    faces.push_back({t.begin(), t.end()});
  }
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, faces);
  find_originals(parts, points, faces);
  for (const auto& point : points) {
    halfedges_.add_vertex(point);
  }
  for (const auto& face : faces) {
    using Vertex = Halfedges::Vertex_index;
    halfedges_.add_face(Vertex(std::uint32_t(face[0])), Vertex(std::uint32_t(face[1])), Vertex(std::uint32_t(face[2])));
  }
}

/// In each face, a copy has the position of one corner.
void OrientedSurface::find_originals(const MeshParts& parts, const std::vector<SurfaceKernel::Point_3>& points,
                                     const Faces& faces) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    original_.push_back(ElementId(p));
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const std::size_t corner : faces[f]) {
      if (corner >= parts.rest.size()) {
        const auto& all = parts.triangles[f];
        original_[corner] =
            *std::find_if(all.begin(), all.end(), [&](ElementId e) { return points[e] == points[corner]; });
      }
    }
  }
}

}  // namespace chainmail::import

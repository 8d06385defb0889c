#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "files/import/program/given_surface.h"
#include "files/import/program/tasks.h"

namespace chainmail::import {
namespace {

using PatchKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Halfedges = CGAL::Surface_mesh<PatchKernel::Point_3>;
using Halfedge = Halfedges::Halfedge_index;
using EdgeEnds = std::array<ElementId, 2>;

// The time grows faster than the square of this number.
constexpr std::size_t most_hole_edges = 10'000;

EdgeEnds ends(ElementId a, ElementId b) { return {std::min(a, b), std::max(a, b)}; }

/// A surface as halfedges. They need faces with one orientation and at most two at an edge: where that is not so, the
/// surface is taken apart, with copies of elements.
class OrientedSurface {
 public:
  explicit OrientedSurface(const MeshParts& parts) : count_(parts.rest.size()) {
    std::vector<PatchKernel::Point_3> points;
    for (const Point& p : parts.rest) {
      points.emplace_back(p.x(), p.y(), p.z());
    }
    std::vector<std::vector<std::size_t>> faces;
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
      halfedges_.add_face(Vertex(std::uint32_t(face[0])), Vertex(std::uint32_t(face[1])),
                          Vertex(std::uint32_t(face[2])));
    }
    faces_ = halfedges_.number_of_faces();
  }

  Halfedges& halfedges() { return halfedges_; }
  ElementId original(Halfedges::Vertex_index vertex) const { return original_[vertex]; }

  /// Returns one halfedge of each border whose edges are all among these.
  std::vector<Halfedge> borders(const std::set<EdgeEnds>& edges) const {
    std::vector<Halfedge> found;
    std::vector<bool> seen(halfedges_.num_halfedges(), false);
    for (const Halfedge start : halfedges_.halfedges()) {
      if (!halfedges_.is_border(start) || seen[start]) {
        continue;
      }
      bool asked = true;
      for (const Halfedge one : CGAL::halfedges_around_face(start, halfedges_)) {
        seen[one] = true;
        asked = asked && edges.contains(ends(original_[halfedges_.source(one)], original_[halfedges_.target(one)]));
      }
      if (asked) {
        found.push_back(start);
      }
    }
    return found;
  }

  /// Returns the points of the surface and the new ones, and the triangles that were added.
  ImportedMesh patches(const MeshParts& parts) const {
    ImportedMesh mesh;
    mesh.parts.rest = parts.rest;
    std::vector<ElementId> ids = original_;
    for (auto v = Halfedges::size_type(original_.size()); v < halfedges_.number_of_vertices(); ++v) {
      const auto& point = halfedges_.point(Halfedges::Vertex_index(v));
      ids.push_back(ElementId(mesh.parts.rest.size()));
      mesh.parts.rest.emplace_back(point.x(), point.y(), point.z());
    }
    for (const auto face : halfedges_.faces()) {
      if (face >= faces_) {
        std::array<ElementId, 3> corners{};
        std::size_t i = 0;
        for (const auto vertex : CGAL::vertices_around_face(halfedges_.halfedge(face), halfedges_)) {
          corners[i++] = ids[vertex];
        }
        mesh.parts.triangles.push_back(corners);
      }
    }
    return mesh;
  }

 private:
  /// Finds the element that each point is a copy of: in each face, it has the position of one corner.
  void find_originals(const MeshParts& parts, const std::vector<PatchKernel::Point_3>& points,
                      const std::vector<std::vector<std::size_t>>& faces) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      original_.push_back(ElementId(p));
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (const std::size_t corner : faces[f]) {
        if (corner >= count_) {
          const auto& all = parts.triangles[f];
          original_[corner] =
              *std::find_if(all.begin(), all.end(), [&](ElementId e) { return points[e] == points[corner]; });
        }
      }
    }
  }

  std::size_t count_;
  Halfedges halfedges_;
  std::vector<ElementId> original_;  // of each point, which may be a copy
  std::size_t faces_ = 0;            // of the surface itself
};

/// Returns the edges around the holes that are given as polygons.
std::set<EdgeEnds> edges_around(const std::vector<ElementId>& polygons) {
  std::set<EdgeEnds> edges;
  for (std::size_t i = 0; i < polygons.size(); i += polygons[i] + 1) {
    const ElementId count = polygons[i];
    if (count > most_hole_edges) {
      refuse("a hole has " + std::to_string(count) + " edges, and at most " + std::to_string(most_hole_edges) +
                 " can be closed",
             "close it in another program");
    }
    for (ElementId j = 0; j < count; ++j) {
      edges.insert(ends(polygons[i + 1 + j], polygons[i + 1 + (j + 1) % count]));
    }
  }
  return edges;
}

/// Closes a hole. The patch is as flat as its border allows (fairing of continuity 0): it neither folds nor bulges.
bool close_hole(Halfedges& surface, Halfedge border) {
  namespace processing = CGAL::Polygon_mesh_processing;
  std::vector<Halfedges::Face_index> faces;
  std::vector<Halfedges::Vertex_index> vertices;
  processing::triangulate_refine_and_fair_hole(surface, border, std::back_inserter(faces), std::back_inserter(vertices),
                                               CGAL::parameters::fairing_continuity(0));
  return !faces.empty();
}

}  // namespace

ImportedMesh close_surface(const std::filesystem::path& path, const Report& report) {
  const ImportedMesh given = read_surface(path);
  const auto edges = edges_around(given.parts.polygons);
  bool closed = false;
  try {
    OrientedSurface surface(given.parts);
    const auto borders = surface.borders(edges);
    for (std::size_t i = 0; i < borders.size(); ++i) {
      report(0.1 + 0.9 * double(i) / double(borders.size()));
      closed = close_hole(surface.halfedges(), borders[i]) || closed;
    }
    if (closed) {
      return surface.patches(given.parts);
    }
  } catch (const CGAL::Failure_exception&) {
    refuse("CGAL failed to close its holes", "close them in another program");
  }
  refuse("none of its holes can be closed: their borders meet non-manifold edges, or intersect themselves",
         "close them in another program");
}

}  // namespace chainmail::import

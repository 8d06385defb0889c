#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "files/import/program/given_surface.h"
#include "files/import/program/oriented_surface.h"
#include "files/import/program/tasks.h"

namespace chainmail::import {
namespace {

using EdgeEnds = std::array<ElementId, 2>;

// The time grows faster than the square of this number.
constexpr std::size_t max_hole_edges = 10'000;

EdgeEnds ends(ElementId a, ElementId b) { return {std::min(a, b), std::max(a, b)}; }

/// A surface whose holes are closed.
class HoledSurface : public OrientedSurface {
 public:
  explicit HoledSurface(const MeshParts& parts) : OrientedSurface(parts), faces_(halfedges().number_of_faces()) {}

  /// Returns one halfedge of each border whose edges are all among these. A border that visits copies of one element
  /// is left out: its patch could join them.
  std::vector<Halfedge> borders(const std::set<EdgeEnds>& edges) const {
    std::vector<Halfedge> found;
    std::vector<bool> seen(halfedges().num_halfedges(), false);
    for (const Halfedge start : halfedges().halfedges()) {
      if (!halfedges().is_border(start) || seen[start]) {
        continue;
      }
      for (const Halfedge one : CGAL::halfedges_around_face(start, halfedges())) {
        seen[one] = true;
      }
      const auto around = edges_at(start);
      if (visits_each_once(start) &&
          std::all_of(around.begin(), around.end(), [&](const EdgeEnds& edge) { return edges.contains(edge); })) {
        found.push_back(start);
      }
    }
    return found;
  }

  /// Returns the edges of the border at a halfedge.
  std::vector<EdgeEnds> edges_at(Halfedge border) const {
    std::vector<EdgeEnds> edges;
    for (const Halfedge one : CGAL::halfedges_around_face(border, halfedges())) {
      edges.push_back(ends(originals()[halfedges().source(one)], originals()[halfedges().target(one)]));
    }
    return edges;
  }

  /// Returns the points of the surface and the new ones, and the triangles that were added.
  ImportedMesh patches(const MeshParts& parts) const {
    ImportedMesh mesh;
    mesh.parts.rest = parts.rest;
    std::vector<ElementId> ids = originals();
    for (auto v = Halfedges::size_type(originals().size()); v < halfedges().number_of_vertices(); ++v) {
      const auto& point = halfedges().point(Halfedges::Vertex_index(v));
      ids.push_back(ElementId(mesh.parts.rest.size()));
      mesh.parts.rest.emplace_back(point.x(), point.y(), point.z());
    }
    for (const auto face : halfedges().faces()) {
      if (face >= faces_) {
        std::array<ElementId, 3> corners{};
        std::size_t i = 0;
        for (const auto vertex : CGAL::vertices_around_face(halfedges().halfedge(face), halfedges())) {
          corners[i++] = ids[vertex];
        }
        mesh.parts.triangles.push_back(corners);
      }
    }
    return mesh;
  }

 private:
  bool visits_each_once(Halfedge border) const {
    std::set<ElementId> visited;
    const auto around = CGAL::halfedges_around_face(border, halfedges());
    return std::all_of(around.begin(), around.end(),
                       [&](Halfedge one) { return visited.insert(originals()[halfedges().target(one)]).second; });
  }

  std::size_t faces_;  // of the surface itself
};

using ElementLoop = std::vector<ElementId>;

/// Returns the holes that are given as polygons.
std::vector<ElementLoop> holes_of(const std::vector<ElementId>& polygons) {
  std::vector<ElementLoop> holes;
  for (std::size_t i = 0; i < polygons.size(); i += polygons[i] + 1) {
    const ElementId count = polygons[i];
    if (count > max_hole_edges) {
      refuse("a hole has " + std::to_string(count) + " edges, and at most " + std::to_string(max_hole_edges) +
                 " can be closed",
             "close it in another program");
    }
    const auto first = polygons.begin() + std::ptrdiff_t(i) + 1;
    holes.emplace_back(first, first + count);
  }
  return holes;
}

template <class Visit>
void for_each_edge(const ElementLoop& loop, Visit visit) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    visit(ends(loop[i], loop[(i + 1) % loop.size()]));
  }
}

std::set<EdgeEnds> edges_around(const std::vector<ElementLoop>& holes) {
  std::set<EdgeEnds> edges;
  for (const ElementLoop& hole : holes) {
    for_each_edge(hole, [&](const EdgeEnds& edge) { edges.insert(edge); });
  }
  return edges;
}

/// Closes a hole. The patch is as flat as its border allows (fairing of continuity 0): it neither folds nor bulges.
bool close_hole(Halfedges& surface, Halfedge border) {
  namespace processing = CGAL::Polygon_mesh_processing;
  std::vector<Halfedges::Face_index> faces;
  std::vector<Halfedges::Vertex_index> vertices;
#if CGAL_VERSION_NR >= 1060000000
  processing::triangulate_refine_and_fair_hole(surface, border,
                                               CGAL::parameters::fairing_continuity(0)
                                                   .face_output_iterator(std::back_inserter(faces))
                                                   .vertex_output_iterator(std::back_inserter(vertices)));
#else
  processing::triangulate_refine_and_fair_hole(surface, border, std::back_inserter(faces), std::back_inserter(vertices),
                                               CGAL::parameters::fairing_continuity(0));
#endif
  return !faces.empty();
}

/// Returns the hole in the direction in which its patch has the orientation of the faces next to it.
ElementLoop directed(ElementLoop hole, const MeshParts& parts) {
  const bool along = std::any_of(parts.triangles.begin(), parts.triangles.end(), [&](const auto& t) {
    return (t[0] == hole[0] && t[1] == hole[1]) || (t[1] == hole[0] && t[2] == hole[1]) ||
           (t[2] == hole[0] && t[0] == hole[1]);
  });
  if (along) {
    std::reverse(hole.begin(), hole.end());
  }
  return hole;
}

/// Closes a hole whose border meets another hole or a non-manifold edge, with triangles between its elements only.
void close_alone(const ElementLoop& hole, const MeshParts& given, std::vector<std::array<ElementId, 3>>& triangles) {
  std::vector<SurfaceKernel::Point_3> points;
  for (const ElementId e : hole) {
    points.emplace_back(given.rest[e].x(), given.rest[e].y(), given.rest[e].z());
  }
  std::vector<CGAL::Triple<int, int, int>> patch;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(points, std::back_inserter(patch));
  for (const auto& [a, b, c] : patch) {
    triangles.push_back({hole[std::size_t(a)], hole[std::size_t(b)], hole[std::size_t(c)]});
  }
}

/// Returns the patches of all holes that can be closed.
ImportedMesh closed(const MeshParts& given, const std::vector<ElementLoop>& holes, const Report& report) {
  HoledSurface surface(given);
  std::set<EdgeEnds> open = edges_around(holes);
  const auto borders = surface.borders(open);
  for (std::size_t i = 0; i < borders.size(); ++i) {
    report(0.1 + 0.9 * double(i) / double(borders.size()));
    const auto around = surface.edges_at(borders[i]);
    if (close_hole(surface.halfedges(), borders[i])) {
      std::for_each(around.begin(), around.end(), [&](const EdgeEnds& edge) { open.erase(edge); });
    }
  }
  ImportedMesh mesh = surface.patches(given);
  for (const ElementLoop& hole : holes) {
    bool is_open = true;
    for_each_edge(hole, [&](const EdgeEnds& edge) { is_open = is_open && open.contains(edge); });
    if (is_open) {
      close_alone(directed(hole, given), given, mesh.parts.triangles);
    }
  }
  return mesh;
}

}  // namespace

ImportedMesh close_surface(const std::filesystem::path& path, const Report& report) {
  const ImportedMesh given = read_surface(path);
  try {
    ImportedMesh mesh = closed(given.parts, holes_of(given.parts.polygons), report);
    if (!mesh.parts.triangles.empty()) {
      return mesh;
    }
  } catch (const CGAL::Failure_exception&) {
    refuse("CGAL failed to close its holes", "close them in another program");
  }
  refuse("none of its holes can be closed", "close them in another program");
}

}  // namespace chainmail::import

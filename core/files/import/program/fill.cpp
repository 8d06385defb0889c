#include "files/mesh/fill.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/import/program/given_surface.h"
#include "files/import/program/gmsh_session.h"
#include "files/import/program/tasks.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/mesh.h"

namespace chainmail::import {
namespace {

using Triangle = std::array<ElementId, 3>;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Link = std::array<ElementId, 2>;

std::string numbers(const Triangle& t) {
  return std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]);
}

std::string position_text(const Point& point) {
  std::string text = "(";
  for (int k = 0; k < 3; ++k) {
    text += k > 0 ? ", " : "";
    append_number(text, double(float(point[k])));
  }
  return text + ")";
}

std::vector<Triangle> split(const MeshParts& parts) {
  std::vector<Triangle> triangles = parts.triangles;
  const auto& all = parts.polygons;
  for (std::size_t i = 0; i < all.size(); i += all[i] + 1) {
    for (std::size_t j = 2; j < all[i]; ++j) {
      triangles.push_back({all[i + 1], all[i + j], all[i + j + 1]});
    }
  }
  return triangles;
}

/// Returns the number of triangles at each link.
std::map<Link, int> links_of(const std::vector<Triangle>& triangles) {
  std::map<Link, int> links;
  for (const auto& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      ++links[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
    }
  }
  return links;
}

/// Returns the number of rings in a border in which no element has more than two links.
std::size_t count_rings(const std::vector<Link>& border) {
  std::map<ElementId, ElementId> leader;
  const auto find = [&leader](ElementId e) {
    leader.try_emplace(e, e);
    while (leader[e] != e) {
      e = leader[e] = leader[leader[e]];
    }
    return e;
  };
  for (const auto& [a, b] : border) {
    const ElementId from = find(a), to = find(b);
    leader[from] = to;
  }
  return std::size_t(std::count_if(leader.begin(), leader.end(), [](auto& one) { return one.first == one.second; }));
}

void check_links(const MeshParts& parts, const std::vector<Triangle>& triangles) {
  std::vector<Link> border;
  for (const auto& [link, count] : links_of(triangles)) {
    if (count == 1) {
      border.push_back(link);
    } else if (count > 2) {
      refuse(std::to_string(count) + " faces meet at the link " + std::to_string(link[0]) + "-" +
                 std::to_string(link[1]) + ", near " + position_text(parts.rest[link[0]]),
             "keep two of them");
    }
  }
  if (!border.empty()) {
    const std::size_t holes = count_rings(border);
    refuse("the surface is open: it has " + std::to_string(holes) + (holes == 1 ? " hole" : " holes") +
               ", the first at element " + std::to_string(border[0][0]) + ", near " +
               position_text(parts.rest[border[0][0]]),
           "close its holes (Object > Repair, or chainmail repair)");
  }
}

void check_crossings(const MeshParts& parts, const std::vector<Triangle>& triangles) {
  std::vector<Kernel::Point_3> points;
  std::transform(parts.rest.begin(), parts.rest.end(), std::back_inserter(points),
                 [](const Point& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); });
  std::vector<std::vector<std::size_t>> faces;
  for (const auto& [a, b, c] : triangles) {
    if (CGAL::collinear(points[a], points[b], points[c])) {
      refuse("the face of the elements " + numbers({a, b, c}) + " is flat, near " + position_text(parts.rest[a]),
             "remove it, or move one of them");
    }
    faces.push_back({a, b, c});
  }
  namespace processing = CGAL::Polygon_mesh_processing;
  processing::orient_polygon_soup(points, faces);  // duplicates points where parts touch, which does not matter below
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  processing::polygon_soup_to_polygon_mesh(points, faces, surface);
  using Face = CGAL::Surface_mesh<Kernel::Point_3>::Face_index;
  std::vector<std::pair<Face, Face>> crossings;
  processing::self_intersections(surface, std::back_inserter(crossings));
  if (!crossings.empty()) {
    const auto& [one, other] = crossings.front();
    refuse("the surface intersects itself, at " + std::to_string(crossings.size()) +
               " places: the first is where the faces (" + numbers(triangles[one]) + ") and (" +
               numbers(triangles[other]) + ") meet, near " + position_text(parts.rest[triangles[one][0]]),
           "repair the surface there");
  }
}

/// Returns the triangles of a surface, with polygons split. Throws Error, with elements and positions, if they do not
/// enclose a volume: no triangles, a flat one, a hole, three at one link, or two that intersect.
std::vector<Triangle> closed_surface(const MeshParts& parts) {
  auto triangles = split(parts);
  if (triangles.empty()) {
    refuse("it has no faces, so it has no inside", "use a closed surface");
  }
  check_links(parts, triangles);
  check_crossings(parts, triangles);
  return triangles;
}

/// Returns the volume that the triangles enclose (mesh units cubed).
double enclosed_volume(const MeshParts& parts, const std::vector<Triangle>& triangles) {
  const Point& about = parts.rest[triangles.front()[0]];
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    sum += (parts.rest[a] - about).dot((parts.rest[b] - about).cross(parts.rest[c] - about)) / 6;
  }
  return std::abs(sum);
}

/// Reads the output of Gmsh, which contains its progress: takes the place of standard output. A pipe would need a
/// thread that reads it, and the sandbox has none.
class Narration {
 public:
  /// `expected` is the approximate number of points at the end.
  Narration(double expected, const Report& report) : expected_(expected), report_(report) {
    stream_ = fopencookie(this, "w", {nullptr, &Narration::write, nullptr, nullptr});
    if (stream_ != nullptr) {
      setvbuf(stream_, nullptr, _IOLBF, BUFSIZ);
      std::swap(stdout, stream_);
      gmsh::option::setNumber("General.Terminal", 1);
    }
  }
  Narration(const Narration&) = delete;
  Narration& operator=(const Narration&) = delete;
  ~Narration() {
    if (stream_ != nullptr) {
      gmsh::option::setNumber("General.Terminal", 0);
      std::swap(stdout, stream_);
      std::fclose(stream_);
    }
  }

 private:
  static ssize_t write(void* narration, const char* letters, std::size_t count) {
    static_cast<Narration*>(narration)->take({letters, count});
    return ssize_t(count);
  }
  void take(std::string_view said) {
    static constexpr std::size_t longest_line = 512;
    for (const char letter : said) {
      if (letter != '\n' && line_.size() < longest_line) {
        line_ += letter;
      } else {
        take_line();
        line_.clear();
      }
    }
  }
  void take_line() const {
    static constexpr std::string_view before = "mesh.nvert: ";
    if (const std::size_t at = line_.find(before); at != std::string::npos) {
      const double created = std::strtod(line_.c_str() + at + before.size(), nullptr);
      report_(0.1 + 0.6 * std::min(1.0, created / expected_));
    }
  }

  double expected_;
  const Report& report_;
  std::string line_;
  FILE* stream_ = nullptr;  // then the standard output of before
};

void give_surface(const MeshParts& parts, const std::vector<Triangle>& triangles) {
  gmsh::model::add("surface");
  const int surface = gmsh::model::addDiscreteEntity(2);
  std::vector<std::size_t> tags(parts.rest.size()), corners;
  std::iota(tags.begin(), tags.end(), std::size_t{1});
  std::vector<double> places;
  for (const Point& point : parts.rest) {
    places.insert(places.end(), point.begin(), point.end());
  }
  for (const Triangle& triangle : triangles) {
    std::transform(triangle.begin(), triangle.end(), std::back_inserter(corners), [](ElementId e) { return e + 1; });
  }
  gmsh::model::mesh::addNodes(2, surface, tags, places);
  gmsh::model::mesh::addElementsByType(surface, 2, {}, corners);
  gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop({surface})});
  gmsh::model::geo::synchronize();
}

/// Sets the length of edges, which may be finer or coarser than those of the surface. Uses HXT (Marot et al. 2019):
/// Gmsh's older algorithm ignores the size inside a coarse surface.
void set_size(double size) {
  constexpr int hxt = 10;
  // Quality of a tetrahedron, from 0 to 1. HXT's default of 0.3 takes ten times as long and does not improve ChainMail.
  constexpr double worst_quality = 0.1;
  gmsh::option::setNumber("Mesh.Algorithm3D", hxt);
  gmsh::option::setNumber("Mesh.OptimizeThreshold", worst_quality);
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", size);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  const int field = gmsh::model::mesh::field::add("MathEval");
  std::string length;
  append_number(length, size);
  gmsh::model::mesh::field::setString(field, "F", length);
  gmsh::model::mesh::field::setAsBackgroundMesh(field);
}

void generate() {
  try {
    gmsh::model::mesh::generate(3);
  } catch (...) {  // it throws numbers, strings and exceptions
    refuse("Gmsh cannot fill it (" + gmsh_complaint() + ")", "choose another size, or simplify the surface");
  }
}

/// Returns the points of the surface, then the inner points, with tetrahedra only.
ImportedMesh filled(const MeshParts& surface) {
  ImportedMesh mesh;
  std::vector<std::size_t> tags, cells, nodes;
  std::vector<double> places, unused;
  gmsh::model::mesh::getNodes(tags, places, unused);
  std::vector<ElementId> id(1 + *std::max_element(tags.begin(), tags.end()));
  mesh.parts.rest = surface.rest;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const bool of_surface = tags[i] <= surface.rest.size();
    id[tags[i]] = static_cast<ElementId>(of_surface ? tags[i] - 1 : mesh.parts.rest.size());
    if (!of_surface) {
      mesh.parts.rest.emplace_back(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    }
  }
  gmsh::model::mesh::getElementsByType(4, cells, nodes);
  for (std::size_t i = 0; i + 4 <= nodes.size(); i += 4) {
    mesh.parts.tetrahedra.push_back({id[nodes[i]], id[nodes[i + 1]], id[nodes[i + 2]], id[nodes[i + 3]]});
  }
  return mesh;
}

}  // namespace

ImportedMesh fill_surface(const std::filesystem::path& path, double size, const Report& report) {
  const ImportedMesh surface = read_surface(path);
  const auto triangles = closed_surface(surface.parts);
  report(0.1);
  const GmshSession session;
  give_surface(surface.parts, triangles);
  set_size(size);
  const double expected = enclosed_volume(surface.parts, triangles) / (size * size * size) * points_per_cube;
  if (expected > double(element_limit)) {
    refuse("filled with edges of that size it would have more than " + std::to_string(element_limit) + " elements",
           "choose a larger size");
  }
  {
    const Narration narration(expected + 1, report);
    generate();
  }
  ImportedMesh mesh = filled(surface.parts);
  if (mesh.parts.tetrahedra.empty()) {
    refuse("Gmsh cannot fill it (" + gmsh_complaint() + ")", "choose another size, or simplify the surface");
  }
  return mesh;
}

}  // namespace chainmail::import

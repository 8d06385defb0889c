#include "files/import/program/closed_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "files/import/program/tasks.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::import {
namespace {

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

}  // namespace

std::vector<Triangle> closed_surface(const MeshParts& parts) {
  auto triangles = split(parts);
  if (triangles.empty()) {
    refuse("it has no faces, so it has no inside", "use a closed surface");
  }
  check_links(parts, triangles);
  check_crossings(parts, triangles);
  return triangles;
}

double enclosed_volume(const MeshParts& parts, const std::vector<Triangle>& triangles) {
  const Point& about = parts.rest[triangles.front()[0]];
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    sum += (parts.rest[a] - about).dot((parts.rest[b] - about).cross(parts.rest[c] - about)) / 6;
  }
  return std::abs(sum);
}

}  // namespace chainmail::import

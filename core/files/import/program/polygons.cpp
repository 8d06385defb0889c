#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <iterator>

#include "files/import/program/tasks.h"
#include "mesh/error.h"

namespace chainmail::import {
namespace {

using CgalPoint = CGAL::Simple_cartesian<double>::Point_3;
using Polygon = std::vector<std::size_t>;

struct Soup {
  std::vector<CgalPoint> points;
  std::vector<Polygon> polygons;
};

bool read(const std::string& name, const std::string& path, Soup& soup) {
  return name == "off" ? CGAL::IO::read_OFF(path, soup.points, soup.polygons)
                       : CGAL::IO::read_STL(path, soup.points, soup.polygons);
}

void add_polygon(MeshParts& parts, const Polygon& polygon) {
  if (polygon.size() < 2 ||
      std::any_of(polygon.begin(), polygon.end(), [&](auto corner) { return corner >= parts.rest.size(); })) {
    refuse("a face names a point that does not exist, or has fewer than 2 corners", "export it again");
  }
  add_face(parts, std::vector<ElementId>(polygon.begin(), polygon.end()));
}

}  // namespace

ImportedMesh read_polygons(const std::string& name, const std::filesystem::path& path) {
  Soup soup;
  if (!read(name, path.string(), soup)) {
    refuse("it is damaged, or not a file of the format " + name + ": CGAL cannot read it to its end",
           "export it again");
  }
  if (soup.points.size() > element_limit) {
    refuse("there are more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
  }
  ImportedMesh mesh;
  std::transform(soup.points.begin(), soup.points.end(), std::back_inserter(mesh.parts.rest),
                 [](const CgalPoint& p) { return Point(p.x(), p.y(), p.z()); });
  for (const Polygon& polygon : soup.polygons) {
    add_polygon(mesh.parts, polygon);
  }
  return mesh;
}

}  // namespace chainmail::import

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <fstream>

#include "files/import/tasks.h"
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
  if (name == "off") {
    return CGAL::IO::read_OFF(path, soup.points, soup.polygons);
  }
  if (name == "ply") {
    return CGAL::IO::read_PLY(path, soup.points, soup.polygons);
  }
  return CGAL::IO::read_STL(path, soup.points, soup.polygons);
}

[[noreturn]] void refuse(const std::string& problem, const std::string& remedy) { throw Error("", problem, remedy); }

void add_face(MeshParts& parts, const Polygon& polygon) {
  if (polygon.size() < 2 ||
      std::any_of(polygon.begin(), polygon.end(), [&](auto corner) { return corner >= parts.rest.size(); })) {
    refuse("a face names a point that is not there, or has fewer than 2 corners", "export it anew");
  }
  const auto id = [&](std::size_t i) { return static_cast<ElementId>(polygon[i]); };
  if (polygon.size() == 2) {
    parts.links.push_back({id(0), id(1)});
  } else if (polygon.size() == 3) {
    parts.triangles.push_back({id(0), id(1), id(2)});
  } else {
    parts.polygons.push_back(static_cast<ElementId>(polygon.size()));
    std::transform(polygon.begin(), polygon.end(), std::back_inserter(parts.polygons),
                   [](std::size_t corner) { return static_cast<ElementId>(corner); });
  }
}

}  // namespace

ImportedMesh read_polygons(const std::string& name, const std::filesystem::path& path) {
  Soup soup;
  if (!read(name, path.string(), soup)) {
    refuse("it is damaged, or no " + name + " file: CGAL cannot read it to its end", "export it anew");
  }
  if (soup.points.size() > element_limit) {
    refuse("there are more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
  }
  ImportedMesh mesh;
  std::transform(soup.points.begin(), soup.points.end(), std::back_inserter(mesh.parts.rest),
                 [](const CgalPoint& p) { return Point(p.x(), p.y(), p.z()); });
  for (const Polygon& polygon : soup.polygons) {
    add_face(mesh.parts, polygon);
  }
  return mesh;
}

}  // namespace chainmail::import

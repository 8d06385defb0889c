#include "files/mesh/fill.h"

#include <gmsh.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "files/import/program/closed_surface.h"
#include "files/import/program/given_surface.h"
#include "files/import/program/gmsh_session.h"
#include "files/import/program/tasks.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::import {
namespace {

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

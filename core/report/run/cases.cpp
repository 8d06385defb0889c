#include "report/run/cases.h"

#include <cmath>
#include <numbers>

#include "mesh/error.h"
#include "mesh/generate.h"
#include "report/run/drags.h"
#include "report/run/random.h"

namespace chainmail::report {
namespace {

void add_triangle(MeshParts& parts, ElementId a, ElementId b, ElementId c) {
  parts.triangles.push_back({a, b, c});
  parts.links.insert(parts.links.end(), {{a, b}, {b, c}, {c, a}});
}

/// Returns triangles in a plane, with links of different lengths. Elements are displaced by up to 0.3 mesh units along
/// each axis, and each square is split along a random diagonal.
MeshPointer jittered_cloth(std::uint32_t width, std::uint32_t height) {
  std::mt19937_64 random(2004);
  MeshParts parts;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const double across = uniform(random, -0.3, 0.3);
      const double up = uniform(random, -0.3, 0.3);
      parts.rest.emplace_back(x + across, y + up, 0);
    }
  }
  for (std::uint32_t y = 0; y + 1 < height; ++y) {
    for (std::uint32_t x = 0; x + 1 < width; ++x) {
      const ElementId a = x + width * y, b = a + 1, c = a + width, d = c + 1;
      const bool rising = uniform(random, 0, 1) < 0.5;
      add_triangle(parts, a, b, rising ? d : c);
      add_triangle(parts, rising ? a : b, d, c);
    }
  }
  return build_mesh(std::move(parts));
}

/// Returns a closed surface: rings of triangles between two poles.
MeshPointer sphere(std::uint32_t segments, std::uint32_t rings, double radius) {
  MeshParts parts;
  parts.rest.emplace_back(0, 0, radius);
  for (std::uint32_t i = 0; i < segments * rings; ++i) {
    const std::uint32_t ring = i / segments, segment = i % segments;
    const double down = std::numbers::pi * (ring + 1) / (rings + 1);
    const double around = 2 * std::numbers::pi * segment / segments;
    parts.rest.push_back(radius *
                         Point(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)));
  }
  parts.rest.emplace_back(0, 0, -radius);
  const auto at = [&](std::uint32_t ring, std::uint32_t segment) { return 1 + ring * segments + segment % segments; };
  for (std::uint32_t s = 0; s < segments; ++s) {
    add_triangle(parts, 0, at(0, s), at(0, s + 1));
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      add_triangle(parts, at(ring, s), at(ring + 1, s), at(ring + 1, s + 1));
      add_triangle(parts, at(ring, s), at(ring + 1, s + 1), at(ring, s + 1));
    }
    add_triangle(parts, at(rings - 1, s), 1 + rings * segments, at(rings - 1, s + 1));
  }
  return build_mesh(std::move(parts));
}

/// Returns the links of random holes, and of a slit from the left edge to the middle.
std::vector<LinkId> slit_and_holes(const Mesh& grid) {
  std::mt19937_64 random(2004);
  const std::uint32_t width = grid.lattice->size[0], slit = grid.lattice->size[1] / 3;
  std::vector<LinkId> cuts;
  for (LinkId link = 0; link < grid.link_count(); ++link) {
    const auto [a, b] = grid.links[link];
    const bool crosses = b == a + width && a / width == slit && a % width < width / 2;
    if (const bool hole = uniform(random, 0, 1) < 0.08; hole || crosses) {
      cuts.push_back(link);
    }
  }
  return cuts;
}

/// Returns a softness in which links within the middle third of each axis are ten times as stiff as the others.
Softness with_stiff_middle(const Mesh& mesh, const Softness& soft) {
  LinkSoftness stiff = soft.global;
  stiff.compression = 1 - (1 - soft.global.compression) / 10;
  stiff.stretch = 1 + (soft.global.stretch - 1) / 10;
  stiff.shear = soft.global.shear / 10;
  stiff.stiffness = 10 * soft.global.stiffness;
  const auto [low, high] = bounds(mesh);
  const auto inside = [&, a = low, b = high](ElementId element) {
    const Point from_middle = mesh.rest_position(element) - (a + b) / 2;
    return ((6 * from_middle).cwiseAbs().array() <= (b - a).array()).all();
  };
  Softness softness = soft;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    if (const auto [a, b] = mesh.links[link]; inside(a) && inside(b)) {
      softness.links.set(link, stiff);
    }
  }
  return softness;
}

}  // namespace

std::vector<Case> default_cases(const Softness& softness) {
  const auto grid = generate({MeshKind::grid, {32, 32, 1}});
  const auto made = [&](const char* name, const char* description, MeshPointer mesh) -> Case {
    return {name, description, std::move(mesh), {}, {}, softness, {}};
  };
  std::vector<Case> cases{
      made("grid", "32 × 32 elements, links along x and y", grid),
      made("cut grid", "the grid with a slit to its middle, and 8 % of the other links cut at random", grid),
      made("jittered cloth", "32 × 32 elements displaced by up to 0.3, triangles along random diagonals",
           jittered_cloth(32, 32)),
      made("sphere", "a closed surface of triangles: 20 rings of 32 elements and two poles", sphere(32, 20, 6)),
      made("tetra block", "10 × 10 × 10 elements, each cube split into six tetrahedra",
           generate({MeshKind::tetra, {10, 10, 10}})),
      made("stiff inclusion", "the grid, with links ten times as stiff in its middle", grid),
  };
  cases[1].cuts = slit_and_holes(*grid);
  cases[5].softness = with_stiff_middle(*grid, softness);
  for (Case& one : cases) {
    one.drags = three_drags(one);
  }
  return cases;
}

RecordedMoves drag_along(const std::string& name, const Body& body, const std::vector<ElementId>& elements,
                         const std::vector<Motion>& path) {
  const Mesh& mesh = body.mesh();
  const std::string where = "drag '" + name + "'";
  const Handle handle(body, elements);
  if (path.empty()) {
    throw Error(where, "its path is empty", "give at least one motion");
  }
  RecordedMoves moves{name, "", {commands::Grab(elements)}};
  // Targets are absolute for a handle of one element, as the comparison with physics reads them.
  const Point from = handle.has_one() ? mesh.rest_position(elements[0]) : Point(Point::Zero());
  for (const Motion& motion : path) {
    check_displacement(mesh, where, motion.by);
    check(motion.rotation, mesh);
    moves.commands.emplace_back(commands::Drag{from + motion.by, motion.rotation, !handle.has_one()});
  }
  return moves;
}

Case case_of(const Body& body, const std::string& name) {
  const auto pins = body.pins();
  return {.name = name,
          .description = "object of a program",
          .mesh = body.mesh_pointer(),
          .cuts = body.cuts().links(),
          .pins = {pins.begin(), pins.end()},
          .softness = body.softness(),
          .drags = {},
          .elastic = body.elastic()};
}

}  // namespace chainmail::report

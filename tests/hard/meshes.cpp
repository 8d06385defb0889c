#include "hard/meshes.h"

#include <cmath>
#include <numbers>

namespace chainmail::hard {
namespace {

Point random_point(std::mt19937_64& random, double size) {
  return {test::uniform(random, -size, size), test::uniform(random, -size, size), test::uniform(random, -size, size)};
}

Point turn(const Point& p) {
  const double c = std::numbers::sqrt2 / 2;
  return {c * (p[0] - p[1]), c * (p[0] + p[1]), 0};
}

}  // namespace

MeshPointer doubled_grid(std::uint32_t side) {
  const auto grid = make_grid(side, side);
  MeshParts parts = test::placed(*grid, [](const Point& p) { return p; });
  const ElementId n = grid->element_count();
  for (ElementId e = 0; e < n; ++e) {
    parts.rest.push_back(grid->rest_position(e));
    parts.links.push_back({e, e + n});
  }
  return build_mesh(std::move(parts));
}

MeshPointer far_grid(std::uint32_t side, double origin, double spacing) {
  const auto map = [&](const Point& p) { return Point(origin + spacing * p[0], origin + spacing * p[1], 0); };
  return build_mesh(test::placed(*make_grid(side, side), map));
}

MeshPointer decades_chain() {
  MeshParts parts;
  double x = 0;
  parts.rest.emplace_back(x, 0, 0);
  for (int i = -6; i <= 18; ++i) {
    x += std::pow(10, i <= 6 ? i : 12 - i);
    parts.rest.emplace_back(x, 0, 0);
    parts.links.push_back({static_cast<ElementId>(i + 6), static_cast<ElementId>(i + 7)});
  }
  return build_mesh(std::move(parts));
}

MeshPointer star(std::uint32_t arms) {
  std::mt19937_64 random(1);
  MeshParts parts;
  parts.rest.emplace_back(0, 0, 0);
  for (ElementId e = 1; e <= arms; ++e) {
    parts.rest.push_back(random_point(random, 1));
    parts.links.push_back({0, e});
  }
  return build_mesh(std::move(parts));
}

MeshPointer complete_graph(std::uint32_t count) {
  std::mt19937_64 random(2);
  MeshParts parts;
  for (ElementId e = 0; e < count; ++e) {
    parts.rest.push_back(random_point(random, 5));
    for (ElementId other = 0; other < e; ++other) {
      parts.links.push_back({other, e});
    }
  }
  return build_mesh(std::move(parts));
}

MeshPointer slivers(std::uint32_t side) {
  std::mt19937_64 random(3);
  const auto regular = test::make_mesh(MeshKind::tetra, {side, side, side});
  MeshParts parts = test::placed(*regular, [&](const Point& p) { return Point(p + random_point(random, 1.2)); });
  parts.tetrahedra = regular->tetrahedra;
  for (std::size_t i = 0; i < parts.tetrahedra.size(); i += 3) {  // a third of them, flat to a millionth
    const auto& t = parts.tetrahedra[i];
    parts.rest[t[3]] = (parts.rest[t[0]] + parts.rest[t[1]] + parts.rest[t[2]]) / 3 + random_point(random, 1e-6);
  }
  return build_mesh(std::move(parts));
}

MeshPointer turned_grid() { return build_mesh(test::placed(*make_grid(16, 16), turn)); }

Outcome turned(const Contender& contender, Precision precision) {
  const auto grid = make_grid(16, 16);
  const Point by(4, 2, 0);
  Scene straight(grid, contender, precision, {});
  straight.drag_by(120, by, 4);
  Scene scene(turned_grid(), contender, precision, {});
  scene.drag_by(120, turn(by), 4);
  auto expected = straight.positions();
  for (ElementId e = 0; e < grid->element_count(); ++e) {
    const Point p = turn(Point(expected[2 * e], expected[2 * e + 1], 0));
    expected[2 * e] = p[0];
    expected[2 * e + 1] = p[1];
  }
  Outcome outcome = scene.outcome();
  outcome.drift = distance_between(*grid, expected, scene.positions());
  return outcome;
}

}  // namespace chainmail::hard
